"""Expression packing: as few expressions as possible that together show every blendshape of a template.

Carrigan, Zell, Guiard & McDonnell, "Expression Packing: As-Few-As-Possible Training Expressions for Blendshape
Transfer", Computer Graphics Forum 39(2), 2020, doi:10.1111/cgf.13925; equations and Algorithm 1 are that paper's.

Shapes become sets of vertices (`activity`), get an importance (`importance`) and partners (`symmetry`,
`poseability`), and are worn together where they share no vertex (`units`, `solver`, `orders`). `pack` puts it together.

We differ in how, not in what, is solved. A pair is one variable instead of two that are set equal, and the thousands
of vertices that forbid the same are one row, so that an exact solver needs milliseconds an expression. Beside the
published order there is one with the fewest expressions, which are proven to be the fewest: shapes that share a vertex
are joined by an edge, and the least number of expressions is the chromatic number of that graph.

Symbols: ``K`` shapes, ``N`` vertices, ``T`` triangles, ``U`` units, ``R`` rows.
"""
