"""Elements that need more of their bodies than any random system has: each with a function that draws a system."""

from __future__ import annotations

from collections.abc import Callable

from symbody import System

ELEMENTS: dict[str, Callable[[int], System]] = {}
