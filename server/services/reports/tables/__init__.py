"""The tables of the data, as files."""
