"""Lowering: how long it takes to write expressions as straight-line code."""
