"""The names of Greek letters, which Maple shows as letters."""

from __future__ import annotations

__all__ = ["GREEK", "SMALL"]

_SMALL = """alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho sigma tau upsilon
phi chi psi omega"""
_CAPITAL = "Gamma Delta Theta Lambda Xi Sigma Upsilon Phi Psi Omega"

SMALL = frozenset(_SMALL.split())
"""Small letters."""

GREEK = SMALL | frozenset(_CAPITAL.split())
"""Small letters, and the capitals that differ from Latin letters; ``Pi`` is a number."""
