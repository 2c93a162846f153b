"""Equations of motion as a textbook prints them: the form for the reader, never that of computation."""
