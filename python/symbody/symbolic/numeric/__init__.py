"""From expressions to numbers: programs of routines, tapes, and the kernel that solves linear systems at run time."""
