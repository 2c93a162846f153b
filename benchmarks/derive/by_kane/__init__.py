"""The problems as a user of `sympy.physics.mechanics` writes them, by Kane's method."""
