"""The computation behind Emogen: arrays in, arrays out; no web, no database, no clock."""
