"""How alike two faces are: the metrics of EmoGen 2021, section IV-B."""
