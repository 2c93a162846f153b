"""Expressions as machine code in this process: functions of NumPy arrays, and functions for loops outside Python."""
