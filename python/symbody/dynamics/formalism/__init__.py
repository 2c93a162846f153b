"""Formalisms: from a system to its equations, by Newton, Euler, Lagrange or the recursion of Newton-Euler."""
