"""Spatial arms: each entry has one set of angles, those of the joints and of the frames behind parallel axes."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Equations,
    System,
    Vector,
    cos,
    describe,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    sin,
    symbols,
    translate,
)
from symbody.symbolic.calculus.reading import angles_in
from symbody.symbolic.calculus.single_angles import in_single_angles


def arm(axes: str) -> Equations:
    """An arm whose links have moments of inertia about all axes."""
    count = range(1, len(axes) + 1)
    q, g, frame, bodies = functions_of_time([f"q{k}" for k in count]), symbols("g"), ground, []
    for k, axis, angle in zip(count, axes, q, strict=True):
        m, l, c, Ix, Iy, Iz = symbols(f"m{k} l{k} c{k} I{k}x I{k}y I{k}z")
        frame = frame * rotate(axis, angle)
        bodies.append(Body(frame * translate(c, 0, 0), m, Ix, Iy, Iz))
        frame = frame * translate(l, 0, 0)
    return newton_euler(System(bodies, coordinates=q, gravity=Vector(ground, 0, 0, -g)))


@pytest.fixture(scope="module")
def zyyx() -> Equations:
    return arm("ZYYX")


def test_inertia_about_the_first_axis_is_by_the_angles_of_frames(zyyx: Equations) -> None:
    """`cos(q2 + q3)**2` was hidden as `sin(q2)**2 + 2*cos(q2)*cos(q2 + q3)*cos(q3) - cos(q3)**2`."""
    inertia = str(zyyx.matrix_form().mass_matrix[0, 0])
    assert inertia == (
        "I1z + m1*c1**2 + m2*(l1 + c2*cos(q2))**2 + m3*(l1 + c3*cos(q2 + q3) + l2*cos(q2))**2 "
        "+ m4*(l1 + l2*cos(q2) + (c4 + l3)*cos(q2 + q3))**2 + I2x*sin(q2)**2 + I2z*cos(q2)**2 "
        "+ I3z*cos(q2 + q3)**2 + I4y*cos(q2 + q3)**2*sin(q4)**2 + I4z*cos(q2 + q3)**2*cos(q4)**2 "
        "+ (I3x + I4x)*sin(q2 + q3)**2"
    )


@pytest.mark.parametrize("axes", ["ZYYX", "ZYYZ", "XYYZ"])
def test_no_entry_has_both_angles_of_parallel_joints_and_their_sum(axes: str, zyyx: Equations) -> None:
    equations = zyyx if axes == "ZYYX" else arm(axes)
    q2, q3 = equations.coordinates[1:3]
    shown = equations.matrix_form().mass_matrix
    assert shown == equations.mass_matrix
    for entry in shown.entries:
        assert not {q2, q3, q2 + q3} <= angles_in(entry), entry


def test_a_page_has_no_double_angles_beside_products_of_single_ones() -> None:
    """A cube on its corner: `cos(2*phi)` stood beside `sin(phi)**2 - cos(phi)**2`."""
    q = psi, theta, phi = functions_of_time("psi theta phi")
    m, J, l, g = symbols("m J l g")
    corner = rotate("Z", psi) * rotate("Y", theta) * rotate("X", phi)
    cube = Body(corner * translate(l, l, l), m, J, J, J)
    equations = newton_euler(System([cube], coordinates=q, gravity=Vector(ground, 0, 0, -g)))
    assert "2*phi" not in describe(equations)
    assert any(2 * phi in angles_in(term) for each in equations.display.page.balances for term in each.left)


def test_double_angles_that_the_user_gave_stay() -> None:
    a, b, x = symbols("a b x")
    forms = a * cos(2 * x), b * sin(x) ** 2
    assert in_single_angles(forms, given={2 * x}) == forms
    assert [str(each) for each in in_single_angles(forms)] == [
        "a*(cos(x)**2 - sin(x)**2)",
        "b*sin(x)**2",
    ]
    assert str(in_single_angles([a * cos(2 * x) + a, *forms])[0]) == "2*a*cos(x)**2"
