"""Expressions as functions of machine code in this process: for NumPy arrays, and for loops outside Python."""
