"""What a tyre does at its contact, and the slips on which it depends."""

from __future__ import annotations

from typing import NamedTuple, Protocol, runtime_checkable

from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.symbolic import Expr, Max, number


class TireForce(NamedTuple):
    """The forces and moments of the road on a tyre, in the axes of the contact (ISO 8855: x ahead, y left, z up).

    It is also a law: that of forces that are known, or unknown, whatever the slips are.

    Attributes:
        longitudinal: Fx, in N.
        lateral: Fy, in N.
        overturning: Mx, in N m.
        rolling: My, the rolling resistance, in N m.
        aligning: Mz, in N m.

    >>> from symbody import linear_tire, symbols
    >>> kappa, C = symbols("kappa C")
    >>> linear_tire(longitudinal=C)(1000, kappa)
    TireForce(longitudinal=C*kappa, lateral=0, overturning=0, rolling=0, aligning=0)
    """

    longitudinal: Expr
    lateral: Expr
    overturning: Expr = number(0)
    rolling: Expr = number(0)
    aligning: Expr = number(0)

    def __call__(
        self, load: Scalar, kappa: Scalar = 0, lateral_slip: Scalar = 0, camber: Scalar = 0
    ) -> TireForce:
        """Return the forces as they are."""
        return TireForce(*map(expression, self))


@runtime_checkable
class TireLaw(Protocol):
    """The law of a tyre: its forces by load, slips and camber, such as `linear_tire` or `magic_formula` return.

    Any function with these arguments is a law: the load in N, the longitudinal slip kappa, the lateral slip, which is
    the tangent of the slip angle, and the camber in rad.
    """

    def __call__(
        self, load: Scalar, kappa: Scalar = 0, lateral_slip: Scalar = 0, camber: Scalar = 0
    ) -> TireForce: ...


def pressing(load: Scalar) -> Expr:
    """Return the load where it presses the tyre onto the road; zero where a given one pulls, as no road does.

    >>> from symbody import symbols
    >>> pressing(symbols("N", positive=True)), pressing(symbols("F")), pressing(-5)
    (N, Max(0, F), 0)
    """
    given = expression(load)
    pushing = Max(given, 0)
    return given if pushing == given else pushing
