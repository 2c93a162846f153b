"""Deflections have one sign in all equations: lengths are subtracted, what is given stands behind the coordinate."""

from __future__ import annotations

import re

import pytest

from symbody import (
    Body,
    Expr,
    Force,
    System,
    Torque,
    functions_of_time,
    ground,
    newton_euler,
    parse,
    rotate,
    spring,
    symbols,
    time_derivative,
    translate,
)

x, y, z, u, phi, psi = functions_of_time("x y z u phi psi")
m, J, c, k, n, l, d, L, F, T = symbols("m J c k n l d L F T")


def _masses(*forces: Expr) -> System:
    places = (x, y, z)[: len(forces)]
    bodies = [Body(translate(place, 0, 0), m) for place in places]
    pairs = zip(bodies, forces, strict=True)
    loads = [Force(ground, force, 0, 0, at=body.center_of_mass, on=body) for body, force in pairs]
    return System(bodies, loads, places)


def _rotors(*torques: Expr) -> System:
    angles = (phi, psi)
    bodies = [Body(rotate("Z", angle), 0, Iz=J) for angle in angles]
    pairs = zip(bodies, torques, strict=True)
    return System(bodies, [Torque(ground, 0, 0, torque, on=body) for body, torque in pairs], angles)


def _pull(stretch: Expr) -> Expr:
    return k * stretch + c * time_derivative(stretch)


def _joined() -> System:
    first, second = (Body(translate(place, 0, 0), m) for place in (x, y))
    ends = first.center_of_mass, second.center_of_mass
    return System([first, second], [spring(*ends, k, free_length=l, on=first, reaction=second)], [x, y])


back, forth, gear = _pull(x - y - l), _pull(y - x - l), _pull(phi / n - psi)
PAGES = {
    "backwards": (
        _masses(F - back, back - n * (y - z - d), n * (y - z - d)),
        "m*x'' + c*(x' - y') + k*(x - y - l) = F",
        "m*y'' - c*(x' - y') - k*(x - y - l) + n*(y - z - d) = 0",
        "m*z'' - n*(y - z - d) = 0",
    ),
    "forwards": (
        _masses(forth, -forth),
        "m*x'' - c*(y' - x') - k*(y - x - l) = 0",
        "m*y'' + c*(y' - x') + k*(y - x - l) = 0",
    ),
    "of a spring": (
        _joined(),
        "m*x'' + k*(x - y - l*sign(x - y)) = 0",
        "m*y'' - k*(x - y - l*sign(x - y)) = 0",
    ),
    "of a given support": (_masses(_pull(u - x - l)), "m*x'' + c*(x' - u') + k*(x - u + l) = 0"),
    "between walls": (
        _masses(k * (L - x - l) - n * (x - d - l)),
        "m*x'' + k*(x - L + l) + n*(x - d - l) = 0",
    ),
    "of three masses": (
        _masses(-k * (x - y - l), k * (x - 2 * y + z - l + d), k * (y - z - d)),
        "m*x'' + k*(x - y - l) = 0",
        "m*y'' + k*(2*y - x - z - d + l) = 0",
        "m*z'' - k*(y - z - d) = 0",
    ),
    "cubic": (
        _masses(-k * (x - y - l) - n * (x - y - l) ** 3, F),
        "m*x'' + k*(x - y - l) + n*(x - y - l)**3 = 0",
        "m*y'' = F",
    ),
    "behind a gear": (
        _rotors(T - gear / n, gear),
        "J*phi'' + c*(phi' - n*psi')/n**2 + k*(phi - n*psi)/n**2 = T",
        "J*psi'' + c*(psi' - phi'/n) + k*(psi - phi/n) = 0",
    ),
}


@pytest.mark.parametrize("name", PAGES)
def test_deflections_have_their_own_sign(name: str) -> None:
    system, *rows = PAGES[name]
    equations = newton_euler(system)
    assert equations.description().splitlines()[1:] == [f"    {row}" for row in rows]
    known = {str(leaf): leaf for leaf in system.leaves}
    for row, residual in zip(rows, equations.residuals, strict=True):
        left, right = row.split(" = ")
        assert parse(left, known) - parse(right, known) == residual
    signs = [re.sub(r"[^-+=]", "", text) for text in ("".join(rows), equations.latex())]
    assert signs[0] == signs[1]
