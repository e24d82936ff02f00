"""When a crack grows and where to: one file per criterion.

Each answers two questions about a tip: `direction`, the angle (rad, left positive) between the
crack and the way it would go by this criterion, and `drive`, how many times larger the load is than
the one at which growth begins (1 at the onset; loads scale K, and J with its square).
"""
