"""Models: the functions of time and state that all motions of a system share, derived and compiled once."""
