"""Calculus and rewriting: derivatives, substitution, other forms of a value, and their operation counts."""
