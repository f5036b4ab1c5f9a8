"""Who took part, and what each of them did."""
