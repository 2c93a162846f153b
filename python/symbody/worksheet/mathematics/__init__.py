"""What the core is not asked for: polynomials, roots, integrals by numbers, counts and sequences of operations."""
