"""Tables, engine and queries: the only SQL."""
