"""What the faces say: mean faces, spread, settling, confusion, and the noise of the search to hold them against."""
