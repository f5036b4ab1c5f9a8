"""Bayesian preference learning: every answer narrows down which face is meant, and chooses the next ten.

The method, a module a step: `prior` (sparse targets), `utility` (two metrics, of which the answers tell the right one),
`likelihood` (a noisy ranking of which only the top is told), `chains` and `sampler` (draws from the posterior),
`proposals` (faces made of draws), `design` (the faces whose comparison tells most), `ending` (how sure it is),
`learning` (the steps together), `strategy` (on state). It follows preferential optimisation with Plackett-Luce answers
(E. Brochu, N. de Freitas and A. Ghosh: Active preference learning with discrete choice data. NeurIPS 20, 2007,
409-416), with a spike-and-slab target in the place of a Gaussian process: a face in mind is one vector, of which most
genes are 0.

Replay: all chance is uniform numbers of the trial's own streams, drawn up front; genes are sums and copies of them, or
rounded to a grid of 2^-24 where a mean or a norm makes them. What is left to the last bit of a mathematics library
decides comparisons only.
"""

from emogen_core.search.preference.strategy import NAME, VERSION, ask, ask_ahead, estimate, init, last, mean_face, tell

__all__ = ["NAME", "VERSION", "ask", "ask_ahead", "estimate", "init", "last", "mean_face", "tell"]
