"""Section IV of EmoGen 2021 on any rig: which runs there are, and what each of its tables and figures says of them."""
