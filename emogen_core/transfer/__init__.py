"""From one face model to another head: its shapes carried over, and which expressions to make for that."""
