"""Frames as chains of motions: their poses, their velocities and accelerations, and the functions that make them."""
