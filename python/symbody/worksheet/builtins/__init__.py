"""Commands of Maple: a table by family."""
