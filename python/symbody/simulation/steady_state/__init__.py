"""Steady motions, rest among them: equilibria, trim, branches over a parameter, and small motions about rest."""
