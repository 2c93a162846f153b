"""What the two MBSymba worksheets printed in full, by name: formula, point and values there."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from symbody.codegen import lambdify
from symbody.symbolic import Expr, functions_of_time, symbols, t

RESULTS = json.loads(
    (Path(__file__).parents[1] / "reference" / "seed_worksheets.json").read_text(encoding="utf-8")
)
PRINTED: dict[str, dict[str, Any]] = {result["id"]: result for result in RESULTS["complete"]}


def assert_values(name: str, expressions: Sequence[Expr], functions: str) -> None:
    """Check the expressions at the worksheet's point; ``functions`` names the functions of time among its names."""
    result = PRINTED[name]
    point = {_leaf(key, functions.split()): value for key, value in result["point"].items()}
    values = lambdify(list(point), expressions)(*point.values())
    assert len(values) == len(result["values"])
    for value, expected in zip(values, result["values"], strict=True):
        assert abs(value - expected) <= 1e-14 * max(1, abs(expected))


def _leaf(key: str, functions: Sequence[str]) -> Expr:
    name, _, dots = key.partition("_")
    if name not in functions:
        return symbols(key)
    leaf = functions_of_time(name)
    return leaf.diff(t, dots.count("d")) if dots else leaf
