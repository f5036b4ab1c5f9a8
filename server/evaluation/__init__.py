"""The report of `emogen evaluate`: the tables of section IV as one page and as CSV files."""
