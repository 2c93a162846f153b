"""Code that generated functions call at run time: the solution of linear systems with pivoting."""
