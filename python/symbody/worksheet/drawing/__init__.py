"""Plots: their pieces, their options, and the files that show them."""
