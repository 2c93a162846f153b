"""Conditions of a steady motion: what must vanish so that the equations can be linearised about given values."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from symbody.errors import ModelError
from symbody.symbolic import Expr, free_symbols, gradient, time_derivative, without_idle_symbols
from symbody.symbolic.given.arguments import brief

from .reference_motion import ReferenceMotion

__all__ = ["Condition", "check_conditions"]

ROUNDED = 1e-8
"""The size of a condition without symbols up to which it is zero but for the digits of given values."""


@dataclass(frozen=True)
class Condition:
    """An expression of parameters that must vanish, because the given values don't make it zero by themselves.

    Attributes:
        name: what it is, for messages.
        value: the expression.
        slopes: its derivatives by the variables of the motion.
    """

    name: str
    value: Expr
    slopes: tuple[Expr, ...]

    @cached_property
    def changes(self) -> tuple[Expr, ...]:
        """By how much small changes of symbols p and variables x change the value e: ``p e_p`` and ``e_x/1000``.

        The sum of their absolute values is what the value is compared with. It is taken of numbers: the absolute value
        of an expression takes long, because the signs of its factors are looked for.
        """
        names = sorted(free_symbols([self.value]), key=str)
        slopes = gradient(self.value, names)
        own = (slope / 1000 for slope in self.slopes if not slope.is_zero)
        return (*own, *(name * slope for name, slope in zip(names, slopes, strict=True)))


def check_conditions(
    motion: ReferenceMotion, named: Iterable[tuple[str, Expr, Sequence[Expr]]]
) -> tuple[Condition, ...]:
    """Return the conditions that only values of parameters can fulfil; raise an error for those that nothing can.

    A condition that vanishes by its value holds for all parameters. One that doesn't is an error, unless a value was
    given in decimals, or by symbols: these may belong to particular values of the parameters.

    Args:
        motion: the motion.
        named: what must vanish, each with its name and its derivatives by the variables.

    Raises:
        ModelError: something doesn't vanish.
    """
    left: list[Condition] = []
    for name, value, slopes in named:
        if value.is_zero:
            continue
        varying = motion.varying(value)
        if varying:
            raise ModelError(_unsteady(motion, name, value, varying[0]))
        (form,) = motion.first(without_idle_symbols((value,)))
        if form.is_constant:
            if abs(float(form)) > ROUNDED * max(1.0, *_sizes(slopes)):
                raise ModelError(_off(name, f"{float(form):.6g}"))
        elif motion.is_particular:
            left.append(Condition(name, form, motion.first(slopes)))
        else:
            raise ModelError(_off(name, brief(form)))
    return tuple(left)


def _sizes(slopes: Sequence[Expr]) -> list[float]:
    """Return the sizes of derivatives that are numbers: rounded coordinates are off by a millionth of them."""
    return [0.0, *(abs(float(slope)) for slope in slopes if slope.is_constant)]


def _unsteady(motion: ReferenceMotion, name: str, value: Expr, moving: Expr) -> str:
    """Return the message for a residual that changes along the motion, with the speeds that a turn would change."""
    along = [str(u) for u, v in motion.speeds.items() if not v.is_zero and u != time_derivative(moving)]
    text = str(value)
    off = (
        f"is off by {text}, which changes with {moving}" if len(text) <= _SHORT else f"changes with {moving}"
    )
    if not along:
        way = (
            "expected values in about with which it vanishes at all times, or speeds in axes that turn with the "
            "motion, as those of moving_frame"
        )
    else:
        way = (
            f"if {moving} turns the body, its speeds along fixed axes change, here {brief(', '.join(along))}; expected "
            "a steady turn, which steady(...) finds, values in about with which the equation holds at all times, or "
            "speeds along the body's axes, as those of moving_frame"
        )
    return f"linearize: the motion is not steady: {name} {off}; {way}"


_SHORT = 60
"""The length up to which a residual is shown: half a formula tells nothing."""


def _off(name: str, residual: str) -> str:
    return (
        f"linearize: the values in about are no steady motion: {name} is off by {residual}; give the values of an "
        "equilibrium or of a steady motion, as numbers or as symbols of your own, such as about={theta: theta0}, and "
        "the inputs that belong to it"
    )
