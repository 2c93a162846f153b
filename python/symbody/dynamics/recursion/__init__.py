"""Recursions over the tree: inverse dynamics, the mass matrix, articulated bodies."""
