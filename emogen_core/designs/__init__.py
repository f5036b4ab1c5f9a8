"""Studies of simulated people of whom the truth is known, analysed as recorded ones are: how often tests are right."""
