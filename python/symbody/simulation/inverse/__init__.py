"""Inverse dynamics: the forces that make a system move as it is said to."""
