"""Outputs: expressions that generated code computes in addition to the equations of motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, TypeAlias

from symbody.geometry import Vector
from symbody.symbolic import Expr, ExprLike, Matrix

__all__ = ["Output", "Outputs"]

Output: TypeAlias = Expr | Vector | Matrix | Sequence[ExprLike]
Outputs: TypeAlias = Annotated[
    Mapping[str, Output], "a dictionary of expressions, vectors or matrices by name, such as {'force': k * x}"
]
