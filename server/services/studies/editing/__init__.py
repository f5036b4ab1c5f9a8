"""A study as a form: generated from the schema, read back without losing a letter (docs/study.md, The form)."""
