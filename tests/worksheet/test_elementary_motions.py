"""The motions of a matrix are found again from its entries, whatever form they have."""

from collections.abc import Callable
from pathlib import Path

import pytest

from symbody.geometry import Frame, rotate, translate
from symbody.symbolic import (
    Expr,
    UndefinedFunction,
    cos,
    expand_trig,
    functions_of_time,
    pi,
    simplify,
    symbols,
    t,
)
from symbody.worksheet.mechanics.elementary_motions import frame_of
from tests.worksheet.printed_by import printed

x, y, z, psi, phi, mu, delta = functions_of_time("x y z psi phi mu delta")
V, R, h, l, b, eps = symbols("V R h l b epsilon")
q = symbols("q")

FRAMES = {
    "a vehicle": translate(x, y, h) * rotate("Z", psi) * rotate("X", phi),
    "a double pendulum": rotate("Z", psi) * translate(l, 0, 0) * rotate("Z", phi) * translate(l, 0, 0),
    "a front fork": (
        translate(x, y, z) * rotate("Z", psi) * rotate("X", phi) * rotate("Y", mu) * translate(b, 0, -h)
        * rotate("Y", eps) * rotate("Z", delta) * translate(l, 0, 0)
    ),
    "a rolling wheel": translate(R * mu, 0, 0) * rotate("Y", -mu),
    "a given speed": rotate("Z", V * t / R) * rotate("X", 2 * phi),
    "functions of a variable": translate(UndefinedFunction("X")(q), 0, 0) * rotate("Z", UndefinedFunction("P")(q)),
    "a crank beside": translate(l * cos(phi), 0, 0) * rotate("Z", pi / 3 + phi / 2),
    "an oblique axis": rotate("X", pi / 6) * rotate("Z", phi) * translate(l, 0, 0),
    "Euler angles": rotate("Z", psi) * rotate("X", phi) * rotate("Z", mu),
    "an inverse": (translate(x, y, 0) * rotate("Z", psi) * rotate("X", phi)).inverse(),
}  # fmt: skip
FORMS: dict[str, Callable[[Expr], Expr]] = {
    "as they are": lambda e: e,
    "simplified": simplify,
    "expanded": expand_trig,
}


@pytest.mark.parametrize("form", FORMS.values(), ids=FORMS.keys())
@pytest.mark.parametrize("frame", FRAMES.values(), ids=FRAMES.keys())
def test_motions_are_found_again(frame: Frame, form: Callable[[Expr], Expr]) -> None:
    found = frame_of([form(entry) for entry in frame.matrix.entries])
    assert found is not None
    assert found.matrix == frame.matrix
    assert len(found.motions) <= len(frame.motions) + 1


@pytest.mark.parametrize(
    "matrix",
    [
        [[cos(phi), phi, 0, 0], [-phi, cos(phi), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
        [[1, -psi, 0, x], [psi, 1, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]],
    ],
    ids=["no rotation", "of first order"],
)
def test_what_is_no_product_of_motions_has_none(matrix: list[list[Expr]]) -> None:
    assert frame_of([entry + 0 * x for row in matrix for entry in row]) is None


def test_bodies_that_were_saved_have_energies_as_short_as_before(tmp_path: Path) -> None:
    lines = printed(
        "restart: with(MBSymba_r6): "
        "T := translate(x(t),y(t),0)*rotate('Z',psi(t))*rotate('X',phi(t))*translate(0,0,h)*rotate('Y',mu(t)): "
        "B := make_BODY(T*translate(a,0,b), m, Ix, Iy, Iz, 0, Cxz): K := kinetic_energy(B): save B, T, K, `b.mpl`: "
        "restart: with(MBSymba_r6): read `b.mpl`: "
        "K2 := kinetic_energy(B): length(K2) - length(K), simplify(K2 - K); "
        "K3 := kinetic_energy(make_BODY(T*translate(a,0,b), m, Ix, Iy, Iz, 0, Cxz)): length(K3) - length(K), K3 - K;",
        tmp_path,
    )
    assert lines[-2:] == ["0, 0", "0, 0"]
