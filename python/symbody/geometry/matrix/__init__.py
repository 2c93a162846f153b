"""Numeric and rounded rotation matrices, and matrices of angles: what they stand for, and what is wrong with them."""
