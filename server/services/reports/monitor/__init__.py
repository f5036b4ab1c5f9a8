"""How a study goes while people take part: the live page and the list of studies."""
