"""Making studies, changing them, inviting people, sending simulated ones."""
