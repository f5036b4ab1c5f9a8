"""Does the record tell the truth? Every face is made again from configuration, seeds and choices."""
