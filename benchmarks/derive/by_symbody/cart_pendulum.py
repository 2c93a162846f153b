"""The planar pendulum of n links on a cart: that of `symbody.models`, with point masses."""

from __future__ import annotations

from symbody import System
from symbody.models import cart_pole


def system(n: int) -> System:
    """Return the pendulum; its angles are clockwise from the upward vertical, and the masses sit at the joints."""
    return cart_pole(n, point_masses=True).system
