"""`emogen analyse`: what the faces of an export say, as a page with its numbers and a text for a paper."""
