"""The report of a study from the dashboard: asked for, made by a process of its own, kept with the data."""
