"""The Carvallo-Whipple bicycle, linearised at upright running."""

from __future__ import annotations

from symbody import (
    Body,
    Equations,
    Expr,
    Frame,
    Matrix,
    Point,
    System,
    Vector,
    cos,
    diff,
    expand,
    functions_of_time,
    ground,
    moving_frame,
    newton_euler,
    number,
    rotate,
    simplify,
    sqrt,
    subs,
    symbols,
    t,
    translate,
)
from symbody.dynamics.equations.equations import Assembly, Derived

from .classic import Classic

w, c, lam, g, v, rR, mR, IRx, IRy, rF, mF, IFx, IFy = symbols("w c lam g v rR mR IRx IRy rF mF IFx IFy")
xB, zB, mB, IBx, IBy, IBz, IBxz = symbols("xB zB mB IBx IBy IBz IBxz")
xH, zH, mH, IHx, IHy, IHz, IHxz = symbols("xH zH mH IHx IHy IHz IHxz")
x, y, psi, phi, delta = functions_of_time("x y psi phi delta")


def bicycle() -> System:
    """The axes are forwards, to the right and down; the origin is the contact of the rear wheel, which runs with v.

    The lean phi and the steering angle delta are small: the rate of the yaw is exact to first order, that of the wheels
    to first order, and the pitch, which keeps the front wheel on the ground, to second order.
    """
    yaw_rate = (v * delta + c * delta.diff(t)) * cos(lam) / w
    base = moving_frame(v, 0, 0, 0, 0, yaw_rate, pose=translate(x, y, 0) * rotate("Z", psi))
    rear, front = _frames(base, _pitch())
    wheel = -v * t
    bodies = [
        Body(rear * translate(0, 0, -rR) * rotate("Y", wheel / rR), mR, IRx, IRy, IRx),
        Body(Point(rear, xB, 0, zB), mB, IBx, IBy, IBz, 0, -IBxz, 0),
        Body(Point(front, xH, 0, zH), mH, IHx, IHy, IHz, 0, -IHxz, 0),
        Body(front * translate(w, 0, -rF) * rotate("Y", wheel / rF), mF, IFx, IFy, IFx),
    ]
    return System(bodies, coordinates=[phi, delta], gravity=Vector(ground, 0, 0, g))


def _frames(base: Frame, pitch: Expr) -> tuple[Frame, Frame]:
    """Return the frames of the rear part and the fork, whose axes are those of the ground if the bicycle is upright."""
    rear = base * rotate("X", phi) * translate(0, 0, -rR) * rotate("Y", pitch) * translate(0, 0, rR)
    steering = translate(w + c, 0, 0) * rotate("Y", lam) * rotate("Z", delta) * rotate("Y", -lam)
    return rear, rear * steering * translate(-w - c, 0, 0)


def _pitch() -> Expr:
    """Return the pitch with which the lowest point of the front wheel is on the ground, to second order."""
    _, front = _frames(ground, number(0))
    (*_, height), (*_, lean) = (
        Point(front, w, 0, -rF).projected(ground).coordinates,
        Vector(front, 0, 1, 0).projected(ground).components,
    )
    lowest = height + rF * sqrt(1 - lean**2)
    rest = {phi: 0, delta: 0}
    second = [
        subs(diff(diff(lowest, a), b), rest) * a * b / (2 * w) for a in (phi, delta) for b in (phi, delta)
    ]
    return sum(second, start=number(0))


def linearised(system: System) -> Equations:
    """Return the equations of motion to first order at rest."""
    equations = newton_euler(system)
    q, rates, accelerations = equations.coordinates, equations.speeds, equations.accelerations
    rest = dict.fromkeys((*accelerations, *rates, *q), 0)

    def first(residual: Expr, unknowns: tuple[Expr, ...]) -> Expr:
        return sum((_entry(residual, u, rest) * u for u in unknowns), start=number(0))

    bias = tuple(first(residual, (*rates, *q)) for residual in equations.residuals)
    rows = [[_entry(residual, a, rest) for a in accelerations] for residual in equations.residuals]
    residuals = tuple(
        first(residual, accelerations) + each
        for residual, each in zip(equations.residuals, bias, strict=True)
    )
    return Equations(system, Derived(residuals), Derived(Assembly(Matrix(rows), bias)))


def _entry(residual: Expr, unknown: Expr, rest: dict[Expr, int]) -> Expr:
    return simplify(expand(subs(diff(residual, unknown), rest)))


_U_H, _U_F = "((xH - w - c)*cos(lam) - zH*sin(lam))", "(rF*sin(lam) - c*cos(lam))"
_MU, _SF, _ST = "c*cos(lam)/w", "IFy/rF", "(IRy/rR + IFy/rF)"
_MX, _MZ = "(mB*xB + mH*xH + mF*w)", "(mB*zB + mH*zH - mF*rF - mR*rR)"
_I_XX = "(IRx + IBx + IHx + IFx + mR*rR**2 + mB*zB**2 + mH*zH**2 + mF*rF**2)"
_I_XZ = "(IBxz + IHxz - mB*xB*zB - mH*xH*zH + mF*w*rF)"
_I_ZZ = "(IRx + IBz + IHz + IFx + mB*xB**2 + mH*xH**2 + mF*w**2)"
_S_A = f"(mH*{_U_H} + mF*{_U_F} + {_MU}*{_MX})"
_A_X = f"(mF*rF*{_U_F} - mH*zH*{_U_H} + (IHx + IFx)*sin(lam) + IHxz*cos(lam))"
_A_Z = f"(mF*w*{_U_F} + mH*xH*{_U_H} + IHxz*sin(lam) + (IHz + IFx)*cos(lam))"
_A_A = (
    f"(mF*{_U_F}**2 + mH*{_U_H}**2 + (IHx + IFx)*sin(lam)**2 + 2*IHxz*sin(lam)*cos(lam)"
    " + (IHz + IFx)*cos(lam)**2)"
)

BICYCLES = (
    Classic(
        "Bicycle, linearised",
        "Meijaard, Papadopoulos, Ruina & Schwab, Proc. R. Soc. A 463 (2007), p. 1955, with the abbreviations put in",
        bicycle,
        (
            (
                f"{_I_XX}*phi'' + ({_A_X} + {_MU}*{_I_XZ})*delta''"
                f" + v*({_MU}*({_ST} - {_MZ}) + ({_SF} + {_I_XZ}/w)*cos(lam))*delta'"
                f" + g*{_MZ}*phi + (v**2*({_ST} - {_MZ})*cos(lam)/w - g*{_S_A})*delta = 0"
            ),
            (
                f"({_A_X} + {_MU}*{_I_XZ})*phi'' + ({_A_A} + 2*{_MU}*{_A_Z} + ({_MU})**2*{_I_ZZ})*delta''"
                f" - v*({_MU}*{_ST} + {_SF}*cos(lam))*phi'"
                f" + v*({_A_Z}*cos(lam)/w + {_MU}*({_S_A} + {_I_ZZ}*cos(lam)/w))*delta'"
                f" - g*{_S_A}*phi + (v**2*({_S_A} + {_SF}*sin(lam))*cos(lam)/w - g*{_S_A}*sin(lam))*delta = 0"
            ),
        ),
        linearised,
    ),
)
