"""The worksheet "Trifilar Pendulum in Natural Coordinates", command by command, against what it printed.

Where the worksheet cut its output short, the terms that are visible are checked.
"""

from __future__ import annotations

from itertools import product

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Point,
    System,
    dot,
    functions_of_time,
    generalized_force,
    ground,
    identity,
    kinetic_energy,
    lagrange,
    lagrange_equations,
    origin,
    project,
    solve,
    sqrt,
    symbols,
    time_derivative,
)
from symbody.symbolic import t
from tests.worksheets.printed import PRINTED, assert_values

ux, vx, uy, vy, uz, vz, l, h, m, g, GE = symbols("ux vx uy vy uz vz l h m g GE")
J = symbols("Jxx Jyy Jzz Jyz Jxz Jxy")
omega, zeta, tau = symbols("omega zeta tau")
q = functions_of_time("xA yA zA xB yB zB xC yC zC wx wy wz")
xA, yA, zA, xB, yB, zB, xC, yC, zC, wx, wy, wz = q
lambdas = functions_of_time(" ".join(f"lambda{k}" for k in range(1, 10)))
gammas = functions_of_time(" ".join(f"gamma{k}" for k in range(1, 10)))


def plate_frame() -> Frame:
    return Frame([[ux, vx, wx, xA], [uy, vy, wy, yA], [uz, vz, wz, zA], [0, 0, 0, 1]])


def vertices(frame: Frame) -> tuple[Point, Point, Point]:
    return (
        origin(frame),
        Point(frame, l * sqrt(3) / 2, -l / 2, 0),
        Point(frame, l * sqrt(3) / 2, +l / 2, 0),
    )


def sides(A: Point, B: Point, C: Point) -> list[Expr]:
    return [dot(side, side) for side in (B - A, C - B, A - C)]


def solution() -> dict[Expr, Expr]:
    _, B, C = vertices(plate_frame())
    BB = B - Point(ground, xB, yB, zB)
    CC = C - Point(ground, xC, yC, zC)
    equations = [*project(BB, ground).components, *project(CC, ground).components]
    return solve(equations, [ux, vx, uy, vy, uz, vz])


def solved_frame() -> Frame:
    return plate_frame().subs(solution())


def orthonormality() -> list[Expr]:
    """Return the six constraints in the order in which the worksheet prints them."""
    R = solved_frame().matrix[:3, :3]
    defect = R.T @ R - identity(3)
    return [defect[i, j] for i, j in ((0, 1), (0, 2), (1, 2), (2, 2), (1, 1), (0, 0))]


def distances() -> list[Expr]:
    A0, B0, C0 = ground_vertices()
    A, B, C = vertices(solved_frame())
    return [dot(wire, wire) - h**2 for wire in (A - A0, B - B0, C - C0)]


def ground_vertices() -> tuple[Point, Point, Point]:
    return (
        Point(ground, 0, 0, h),
        Point(ground, l * sqrt(3) / 2, +l / 2, h),
        Point(ground, l * sqrt(3) / 2, -l / 2, h),
    )


def plate() -> Body:
    """Return the plate as the worksheet has it: its centre of mass in a frame parallel to ground."""
    G = Point(ground, (xA + xB + xC) / 3, (yA + yB + yC) / 3, (zA + zB + zC) / 3)
    return Body(G, m, *J)


def gravity_force(body: Body) -> Force:
    return Force(ground, 0, 0, -m * g, at=body.center_of_mass, on=body)


def worksheet_equations() -> list[Expr]:
    """Return the twelve equations as the worksheet makes them: a Lagrangian with multipliers, by hand."""
    body = plate()
    constraints = orthonormality() + distances()
    L = kinetic_energy(body) - GE + sum(k * phi for k, phi in zip(lambdas, constraints, strict=True))
    forces = generalized_force(gravity_force(body), q)
    return [lagrange(L, coordinate) - Q for coordinate, Q in zip(q, forces, strict=True)]


def system() -> System:
    body = plate()
    constraints = orthonormality() + distances()
    return System(bodies=[body], loads=[gravity_force(body)], coordinates=q, constraints=constraints)


def test_side_lengths() -> None:
    for name, points in (
        ("plate_side_lengths", vertices(plate_frame())),
        ("ground_side_lengths", ground_vertices()),
    ):
        assert sides(*points) == [l**2] * 3
        assert_values(name, sides(*points), "")


def test_equivalence_of_definitions() -> None:
    solz = solution()
    for column, (qA, qB, qC) in zip(
        ((ux, vx), (uy, vy), (uz, vz)), ((xA, xB, xC), (yA, yB, yC), (zA, zB, zC)), strict=True
    ):
        assert solz[column[0]] == sqrt(3) * (qB + qC - 2 * qA) / (3 * l)
        assert solz[column[1]] == -(qB - qC) / l
    TN = solved_frame()
    assert TN.matrix[0, 0] == sqrt(3) / 3 * (xB + xC - 2 * xA) / l
    for point, position in zip(vertices(TN), ((xA, yA, zA), (xB, yB, zB), (xC, yC, zC)), strict=True):
        assert tuple(project(point, ground).coordinates) == position


def test_number_of_coordinates() -> None:
    assert len(q) == int(PRINTED["nq"]["printed"])


def test_rigid_body_constraints() -> None:
    phi = orthonormality()
    assert phi[0].diff(xB).diff(xB) == -2 * sqrt(3) / (3 * l**2)
    assert phi[0] == -sqrt(3) / 3 / l**2 * sum(
        (b + c - 2 * a) * (b - c) for a, b, c in ((xA, xB, xC), (yA, yB, yC), (zA, zB, zC))
    )
    assert phi[1] == sqrt(3) / 3 / l * (
        (xB + xC - 2 * xA) * wx + (yB + yC - 2 * yA) * wy + (zB + zC - 2 * zA) * wz
    )
    assert phi[2] == -(xB - xC) / l * wx - (yB - yC) / l * wy - (zB - zC) / l * wz
    assert phi[3] == wx**2 + wy**2 + wz**2 - 1
    assert phi[4] == (xB - xC) ** 2 / l**2 + (yB - yC) ** 2 / l**2 + (zB - zC) ** 2 / l**2 - 1
    assert phi[5].diff(xA, 2) == 8 / (3 * l**2)
    assert_values("constraint4", [phi[3]], "wx wy wz")


def test_orthonormality_has_no_other_entries() -> None:
    R = solved_frame().matrix[:3, :3]
    defect = R.T @ R - identity(3)
    assert {defect[i, j] for i, j in product(range(3), repeat=2)} == set(orthonormality())


def test_distance_constraints() -> None:
    c1, c2, c3 = distances()
    assert c1 == xA**2 + yA**2 + (-h + zA) ** 2 - h**2
    assert c2 == (-l * sqrt(3) / 2 + xB) ** 2 + (-l / 2 + yB) ** 2 + (-h + zB) ** 2 - h**2
    assert c3 == (-l * sqrt(3) / 2 + xC) ** 2 + (l / 2 + yC) ** 2 + (-h + zC) ** 2 - h**2
    assert_values("c1", [c1], "xA yA zA")


def test_kinetic_energy_is_translational() -> None:
    speeds = [(a + b + c).diff(t) / 3 for a, b, c in ((xA, xB, xC), (yA, yB, yC), (zA, zB, zC))]
    assert kinetic_energy(plate()) == m / 2 * sum(speed**2 for speed in speeds)


def test_generalized_forces() -> None:
    assert generalized_force(gravity_force(plate()), q) == [0, 0, -m * g / 3] * 3 + [0, 0, 0]


def test_lagrange_equations() -> None:
    equations = worksheet_equations()
    assert len(equations) == 12
    for i, equation in enumerate(equations[:9]):
        for j, coordinate in enumerate(q):
            expected = m / 9 if j < 9 and i % 3 == j % 3 else 0
            assert equation.diff(coordinate.diff(t, 2)) == expected
    for i, (equation, corner) in enumerate(zip(equations[9:], ((xB, xC), (yB, yC), (zB, zC)), strict=True)):
        assert equation.diff(corner[0]).diff(lambdas[1]) == -sqrt(3) / (3 * l), i
        assert equation.diff(corner[1]).diff(lambdas[1]) == -sqrt(3) / (3 * l), i


def test_system_gives_the_equations_of_the_worksheet() -> None:
    equations = lagrange_equations(system())
    by_hand = dict(zip(equations.multipliers, lambdas, strict=True))
    assert [residual.subs(by_hand) for residual in equations.residuals] == worksheet_equations()
    assert list(equations.constraints) == orthonormality() + distances()


def test_baumgarte() -> None:
    stabilised = lagrange_equations(system()).baumgarte(omega, zeta)
    for value, phi in zip(stabilised, orthonormality() + distances(), strict=True):
        assert value == omega**2 * phi + 2 * zeta * omega * time_derivative(phi) + time_derivative(phi, 2)


def test_number_of_equations() -> None:
    equations = lagrange_equations(system())
    all_equations = [*equations.residuals, *equations.baumgarte(omega, zeta)]
    assert len(all_equations) == int(PRINTED["n_all_eqns"]["printed"])


def test_multipliers_in_differential_form() -> None:
    assert PRINTED["SL1"]["printed"] == "lambda1(t) = gamma1(t)+tau*diff(gamma1(t),t)"
    forms = {k: gamma + tau * gamma.diff(t) for k, gamma in zip(lambdas, gammas, strict=True)}
    for equation in worksheet_equations():
        differential = equation.subs(forms)
        assert not any(differential.has(k) for k in lambdas)
        for k, gamma in zip(lambdas, gammas, strict=True):
            assert differential.diff(gamma.diff(t)) == tau * equation.diff(k)
