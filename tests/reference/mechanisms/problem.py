"""Reference problems: equations of motion, numbers for them, and where they begin."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from symbody import Equations, Expr


@dataclass(frozen=True)
class Problem:
    """A mechanism that can move.

    Attributes:
        equations: its equations of motion.
        parameters: the values of its parameters.
        initial: coordinates, and rates of coordinates or speeds, at the first instant.
        named: what the reference's numbers are of, by the reference's names.
    """

    equations: Equations
    parameters: dict[Expr, float]
    initial: dict[Expr, float]
    named: dict[str, Expr] = field(default_factory=dict)


def reference(name: str) -> dict[str, Any]:
    """Return what the file of a problem holds."""
    path = Path(__file__).parents[1] / f"{name}.json"
    return json.loads(path.read_text(encoding="utf-8"))  # type: ignore[no-any-return]
