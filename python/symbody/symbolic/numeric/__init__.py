"""The way to numbers: programs of routines, their tape, and the kernel that solves linear systems at run time."""
