"""A four-bar linkage that hangs in a plane, its last pin pulled aside: MotionGenesis' example of statics.

x points down, y aside. Bar A hangs from the origin, B from A's end, C from a pin beside the origin; B's end and C's
meet. All angles are measured from x towards y.
"""

from __future__ import annotations

from symbody import (
    Body,
    Force,
    Frame,
    Point,
    System,
    Vector,
    functions_of_time,
    ground,
    lagrange_equations,
    project,
    rotate,
    symbols,
    translate,
)
from symbody.symbolic import Expr

from .problem import Problem, reference

LN, LA, LB, LC, mA, mB, mC, g, H = PARAMETERS = symbols("LN LA LB LC mA mB mC g H")


def fourbar_statics() -> Problem:
    """Return the linkage; its state is one near the equilibrium, not at it, and fulfils no constraint."""
    qA, qB, qC = coordinates = functions_of_time("qA qB qC")
    A = rotate("Z", qA)
    B = A * translate(LA, 0, 0) * rotate("Z", qB - qA)
    C = translate(0, LN, 0) * rotate("Z", qC)
    bars = [bar(A, LA, mA, "A"), bar(B, LB, mB, "B"), bar(C, LC, mC, "C")]
    end_of_B, end_of_C = Point(B, LB, 0, 0), Point(C, LC, 0, 0)
    pull = Force(ground, 0, H, 0, at=end_of_C, on=bars[2])
    gap = project(end_of_B - end_of_C, ground)
    system = System(bars, [pull], coordinates, gap.components[:2], Vector(ground, g, 0, 0))
    numbers = reference("fourbar_statics")["parameters"]
    return Problem(
        lagrange_equations(system),
        {symbol: numbers[symbol.name] for symbol in PARAMETERS},
        {qA: 0.3, qB: 1.2, qC: 0.7},
    )


def bar(frame: Frame, length: Expr, mass: Expr, name: str) -> Body:
    """Return a thin bar along the x axis of its frame."""
    return Body(Point(frame, length / 2, 0, 0), mass, 0, 0, mass * length**2 / 12, name=name)
