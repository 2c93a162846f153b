"""Calculus and rewriting: derivatives, substitution, other forms of the same value, and what a form costs."""
