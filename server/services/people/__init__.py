"""Who works here: accounts, roles, keys, and the trail of what they did."""
