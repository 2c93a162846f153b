"""What generated code needs at run time beside its own functions: linear systems, solved with pivoting."""
