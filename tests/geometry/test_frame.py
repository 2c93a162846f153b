"""Frames as chains: what they share, merge and cancel, and frames from matrices."""

from __future__ import annotations

from math import cos as cosine
from math import pi as half_turn
from math import sin as sine

import pytest

from symbody import (
    Body,
    Expr,
    Frame,
    Point,
    Vector,
    angular_velocity,
    cos,
    functions_of_time,
    ground,
    identity,
    linear_momentum,
    moving_frame,
    newton_equations,
    number,
    pi,
    project,
    rotate,
    sin,
    sqrt,
    symbols,
    time_derivative,
    translate,
    velocity,
)
from symbody.errors import FrameError

a, b, beta = symbols("a b beta")
x, y, phi, psi = functions_of_time("x y phi psi")
ux, uy, uz, vx, vy, vz, wx, wy, wz = NATURAL = functions_of_time("ux uy uz vx vy vz wx wy wz")


def bare() -> Frame:
    return Frame([[ux, vx, wx, x], [uy, vy, wy, y], [uz, vz, wz, 0], [0, 0, 0, 1]])


@pytest.mark.parametrize(
    ("axis", "rows"),
    [
        ("X", [[1, 0, 0], [0, cos(phi), -sin(phi)], [0, sin(phi), cos(phi)]]),
        ("Y", [[cos(phi), 0, sin(phi)], [0, 1, 0], [-sin(phi), 0, cos(phi)]]),
        ("Z", [[cos(phi), -sin(phi), 0], [sin(phi), cos(phi), 0], [0, 0, 1]]),
    ],
)
def test_rotations_are_active_and_right_handed(axis: str, rows: list[list[Expr]]) -> None:
    assert rotate(axis, phi).matrix[:3, :3].tolist() == rows
    assert rotate(axis.lower(), phi) == rotate(axis, phi)


def test_a_product_is_the_chain() -> None:
    T1 = rotate("X", phi)
    T2 = T1 * translate(a, 0, 0)
    assert T2.parent is T1
    assert [frame.depth for frame in T2.chain] == [0, 1, 2]
    assert (ground * T2) == T2


def test_equal_chains_are_equal_frames() -> None:
    one, two = rotate("Z", phi) * translate(a + b, 0, 0), rotate("Z", phi) * translate(b + a, 0, 0)
    assert one == two
    assert len({one, two}) == 1
    assert one != rotate("Z", phi) * translate(a, b, 0)


def test_rotations_about_one_axis_merge() -> None:
    merged = translate(a, 0, 0) * rotate("Z", phi) * rotate("Z", psi)
    assert merged == translate(a, 0, 0) * rotate("Z", phi + psi)
    assert merged.depth == 2


def test_what_moves_nothing_leaves_no_link() -> None:
    assert translate(0, 0, 0) == ground
    assert rotate("X", phi) * rotate("X", -phi) == ground
    assert rotate("X", phi) * translate(a, 0, 0) * translate(-a, 0, 0) * rotate("X", -phi) == ground


def test_translations_keep_the_frame_between_them() -> None:
    middle = translate(a, 0, 0)
    assert (middle * translate(b, 0, 0)).parent is middle


def test_an_axis_as_a_triple() -> None:
    assert rotate((0, 0, 1), phi) == rotate("Z", phi)
    assert rotate((0, -1.0, 0), phi) == rotate("Y", -phi)
    assert rotate(Vector(ground, 1, 0, 0), phi) == rotate("X", phi)


def test_rotation_about_a_slanted_axis() -> None:
    axis = (sin(beta), 0, cos(beta))
    tilted = rotate("Y", beta) * rotate("Z", phi) * rotate("Y", -beta)
    assert rotate(axis, phi).matrix == tilted.matrix
    assert rotate(axis, phi) * rotate(axis, psi) == rotate(axis, phi + psi)
    assert rotate(axis, phi).inverse() == rotate(axis, -phi)


def test_a_numeric_axis_makes_an_exact_rotation() -> None:
    third = 1 / 3**0.5
    R = rotate((third, third, third), phi).matrix[:3, :3]
    assert identity(3) == R @ R.T
    assert float(R.subs({phi: 1.0})[0, 1]) == pytest.approx((1 - cosine(1.0)) / 3 - sine(1.0) / 3**0.5)


@pytest.mark.parametrize("angle", [0.3, half_turn / 2, -half_turn / 2, half_turn, 0.25 * half_turn])
def test_a_numeric_matrix_makes_an_exact_rotation(angle: float) -> None:
    c, s = cosine(angle), sine(angle)
    T = Frame([[1, 0, 0, 0.1], [0, c, -s, 0.2], [0, s, c, x], [0, 0, 0, 1]])
    R = T.matrix[:3, :3]
    assert identity(3) == R @ R.T
    assert T.is_rigid
    assert [float(entry) for entry in R.entries] == pytest.approx([1, 0, 0, 0, c, -s, 0, s, c])


def test_quarter_turns_of_doubles_are_quarter_turns() -> None:
    c = cosine(half_turn / 2)  # 6e-17
    assert Frame([[c, -1, 0, 0], [1, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) == rotate("Z", pi / 2)
    assert Frame([[1, 0, 0, 0], [0, c, -1.0, 0], [0, 1.0, c, 0], [0, 0, 0, 1]]) == rotate("X", pi / 2)
    upside_down = Frame([[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
    assert upside_down == rotate("Y", pi / 2)


def test_the_angles_of_a_numeric_matrix() -> None:
    placed = rotate("Z", 0.3) * rotate("Y", -0.7) * rotate("X", 1.1)
    rows = [[float(entry) for entry in row] for row in placed.matrix.tolist()]
    assert [float(entry) for entry in Frame(rows).matrix.entries] == pytest.approx(
        [entry for row in rows for entry in row], abs=1e-15
    )


def test_a_bare_matrix_is_kept() -> None:
    TN = bare()
    assert not TN.is_rigid
    assert TN.matrix.tolist() == [[ux, vx, wx, x], [uy, vy, wy, y], [uz, vz, wz, 0], [0, 0, 0, 1]]
    assert (TN * translate(a, 0, 0)).base == ground
    assert (rotate("X", phi) * TN).base == rotate("X", phi)


def test_a_matrix_that_is_a_rotation_is_rigid() -> None:
    c, s = cos(phi), sin(phi)
    assert Frame([[c, -s, 0, x], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]).is_rigid
    assert not Frame([[x, -y, 0, 0], [y, x, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]).is_rigid


@pytest.mark.parametrize(
    ("block", "distance"),
    [
        ([[cos(psi), sin(psi)], [sin(psi), cos(psi)]], ""),
        ([[cos(psi), sin(psi)], [sin(psi), -cos(psi)]], "by 2;"),
        ([[cos(psi), -sin(psi)], [sin(psi), 1]], ""),
        ([[2 * cos(psi), -sin(psi)], [sin(psi), 2 * cos(psi)]], ""),
    ],
)
def test_a_matrix_of_sines_that_is_no_rotation_is_refused(block: list[list[Expr]], distance: str) -> None:
    """No constraint makes it one: angles are free."""
    rows = [[*block[0], 0, x], [*block[1], 0, y], [0, 0, 1, 0], [0, 0, 0, 1]]
    with pytest.raises(FrameError, match=f"at some angles its rows are off a right-handed.*{distance}"):
        Frame(rows)


def test_rounded_numbers_beside_sines_are_no_mistake() -> None:
    c, s, u, v = cos(psi), sin(psi), cosine(0.3), sine(0.3)
    Frame([[c, -s * u, s * v, 0], [s, c * u, -c * v, 0], [0, v, u, 0], [0, 0, 0, 1]])


def test_the_inverse_of_a_bare_matrix_is_the_transpose() -> None:
    defect = (bare().inverse() * bare()).matrix - identity(4)
    assert defect[3, 3] == 0
    assert [defect[i, 3] for i in range(3)] == [0, 0, 0]
    assert defect[0, 0] == ux**2 + uy**2 + uz**2 - 1
    assert defect[0, 1] == ux * vx + uy * vy + uz * vz


def test_the_spin_of_a_bare_matrix() -> None:
    """skew(w) = R^T dR/dt: its entries (z, y), (x, z) and (y, x)."""
    rate = {q: time_derivative(q) for q in NATURAL}
    assert angular_velocity(bare()).components == (
        wx * rate[vx] + wy * rate[vy] + wz * rate[vz],
        ux * rate[wx] + uy * rate[wy] + uz * rate[wz],
        vx * rate[ux] + vy * rate[uy] + vz * rate[uz],
    )


def test_a_point_of_a_bare_matrix_moves_as_its_coordinates_do() -> None:
    position = project(Point(bare(), a, b, 0), ground).coordinates
    assert position == (x + ux * a + vx * b, y + uy * a + vy * b, uz * a + vz * b)
    assert velocity(Point(bare(), a, b, 0)).components == tuple(time_derivative(p) for p in position)


def test_substitution_goes_through_the_chain() -> None:
    T = translate(x, 0, 0) * rotate("Z", phi) * rotate((sin(beta), 0, cos(beta)), psi)
    changed = T.subs({x: a, phi: 2 * psi, beta: 0})
    assert changed == translate(a, 0, 0) * rotate("Z", 3 * psi)
    solved = bare().subs(
        {ux: 1, uy: 0, uz: 0, vx: 0, vy: cos(phi), vz: sin(phi), wx: 0, wy: -sin(phi), wz: cos(phi)}
    )
    assert solved.is_rigid


def test_names_are_for_show() -> None:
    named = rotate("Z", phi).named("TZ")
    assert repr(named) == "TZ"
    assert named == rotate("Z", phi)
    assert repr(ground) == "ground"


def test_a_chain_of_a_thousand_frames() -> None:
    T = ground
    for k in range(500):
        T = T * translate(a, 0, 0) * rotate("XYZ"[k % 3], functions_of_time(f"q{k}"))
    assert T.depth == 1000
    assert T.inverse().depth == 1000
    assert angular_velocity(T).components[0].has(time_derivative(functions_of_time("q0")))
    assert "1000 motions" in repr(T)


def test_latex() -> None:
    assert "bmatrix" in rotate("Z", phi)._repr_latex_()
    assert "bmatrix" in Vector(ground, a, 0, 0)._repr_latex_()
    assert "bmatrix" in Point(ground, a, 0, 0)._repr_latex_()


def test_a_moving_master_frame_carries_what_hangs_on_it() -> None:
    """A vehicle with forward and lateral velocities u, v and yaw rate r in its own axes."""
    u, v, r = functions_of_time("u v r")
    m = symbols("m")
    vehicle = moving_frame(u, v, 0, 0, 0, r, name="vehicle")
    body = Body(translate_on(vehicle), m)
    assert velocity(body.center_of_mass).components == (u - r * b, v + r * a, 0)
    assert linear_momentum(body).frame == vehicle
    du, dv, dr = (time_derivative(value) for value in (u, v, r))
    assert newton_equations(body).components == (
        m * (du - v * r - b * dr - a * r**2),
        m * (dv + u * r + a * dr - b * r**2),
        0,
    )


def translate_on(vehicle: Frame) -> Frame:
    return vehicle * translate(a, b, 0)


def test_exact_radicals_are_recognised_as_angles() -> None:
    half = sqrt(2) / 2
    assert Frame([[half, -half, 0, 0], [half, half, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) == rotate("Z", pi / 4)


def test_an_exact_rotation_matrix_is_kept() -> None:
    """Exactly orthonormal entries are better than angles; where the angles give them back, angles merge."""
    c, s = number(3) / 5, number(4) / 5
    rows = [[c, -s, 0, 1], [s, c, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]
    frame = Frame(rows)
    assert frame.is_rigid
    assert frame.matrix.tolist() == rows
    assert frame.matrix[0, 0] == c
    assert (frame * frame.inverse()).matrix.tolist() == ground.matrix.tolist()
    assert Frame([[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) == rotate("Z", pi / 2)


# Chains in which an angle drops out, whatever displacements are between the rotations.
CANCELLED = {
    "forth and back": (rotate("Z", phi) * translate(a, 0, 0) * rotate("Z", -phi - beta), {beta}),
    "a chain of absolute angles": (
        rotate("X", phi)
        * translate(0, a, 0)
        * rotate("X", psi - phi)
        * translate(0, b, 0)
        * rotate("X", -beta - psi),
        {beta},
    ),
    "three that add up": (
        rotate("Y", phi)
        * translate(a, 0, 0)
        * rotate("Y", psi)
        * translate(a, 0, 0)
        * rotate("Y", beta - phi - psi),
        {beta},
    ),
    "behind another axis": (
        rotate("X", psi) * rotate("Y", phi) * translate(x, 0, 0) * rotate("Y", beta - phi),
        {psi, beta},
    ),
}


@pytest.mark.parametrize(("frame", "leaves"), CANCELLED.values(), ids=CANCELLED)
def test_axes_hold_only_angles_that_turn_them(frame: Frame, leaves: set[Expr]) -> None:
    columns = [frame.matrix[i, j] for i in range(3) for j in range(3)]
    assert set().union(*(entry.free_symbols for entry in columns)) == leaves
    turned = [project(Vector(frame, *unit), ground).components for unit in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    assert set().union(*(entry.free_symbols for vector in turned for entry in vector)) == leaves
    assert columns == [turned[j][i] for i in range(3) for j in range(3)]


def test_axes_that_keep_all_angles_are_products_as_before() -> None:
    frame = rotate("Z", phi) * translate(a, 0, 0) * rotate("Z", psi)
    assert str(frame.matrix[0, 0]) == "cos(phi)*cos(psi) - sin(phi)*sin(psi)"
