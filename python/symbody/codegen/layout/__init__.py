"""From straight-line code to the routines of a language: names, formulas, statements, and the lines of both."""
