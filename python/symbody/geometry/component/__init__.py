"""Triples of components, twists, and how frames turn: what everything else is written in."""
