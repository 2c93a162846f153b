"""Positions and velocities that satisfy constraints, and the places where constraints are dependent."""
