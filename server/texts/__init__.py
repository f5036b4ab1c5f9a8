"""The words of the participant's pages: one catalogue a language, and the pages filled with them."""
