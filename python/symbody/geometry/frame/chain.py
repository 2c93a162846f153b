"""Chains: frames as they are shown in formulas, by the motions that lead to them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, final

from symbody.symbolic import Expr
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.expression.latex_layout import upright

from .frame import Frame

__all__ = ["Chain"]


@final
@dataclass(frozen=True, eq=False)
class Chain:
    r"""A frame as a product of elementary motions, after the last frame that has a name.

    In LaTeX, ``Rot_z(a)`` turns about z and ``Trans(x, y, z)`` displaces, as in the textbooks on robots.

    >>> from symbody import latex, rotate, symbols, translate
    >>> a, alpha = symbols("a alpha")
    >>> print(latex(Chain(translate(a, 0, 0) * rotate("X", alpha))))
    \mathrm{Trans}\left(a, 0, 0\right)\,\mathrm{Rot}_{x}\left(\alpha\right)
    """

    frame: Frame

    def __str__(self) -> str:
        return str(self.frame)


def _variables(chain: Chain) -> list[Expr]:
    return [variable for motion in chain.frame.shown_motions[1] for variable in motion.variables]


def _layout(chain: Chain, texts: Sequence[str]) -> str:
    start, motions = chain.frame.shown_motions
    remaining = iter(texts)
    written = (motion.in_latex([next(remaining) for _ in motion.variables]) for motion in motions)
    return r"\,".join([*([upright(start)] if start else []), *written])


def _rebuilt(_: Chain, parts: Sequence[Any]) -> Chain:
    return Chain(parts[0])


contains(
    Chain,
    Container(
        lambda chain: (chain.frame,),
        _rebuilt,
        layout=_layout,
        shown=_variables,
        advice="the matrix of its frame has one",
    ),
)
