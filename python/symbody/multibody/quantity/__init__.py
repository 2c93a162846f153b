"""Quantities of a model: what its names mean, the units of the SI, and the dimensions that follow."""
