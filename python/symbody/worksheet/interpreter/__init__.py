"""Statements, expressions and calls of procedures: a method for each construct of the language."""
