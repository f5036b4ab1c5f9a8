"""Head models of others, from files to a checked value (`model.HeadModel`), and rigs back into files of others."""
