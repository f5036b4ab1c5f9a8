"""What keeps faces plausible: combinational products and, later in the order, the collision stage."""
