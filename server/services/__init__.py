"""The study's rules. Services know the store and the core, and no web framework."""
