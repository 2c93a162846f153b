"""Positions and velocities that satisfy constraints, and where constraints depend on each other."""
