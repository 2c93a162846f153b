"""`simplify` reaches the forms that textbooks print, starting from frames and Lagrange's equations.

A form counts as reached when it is the textbook's up to the order of terms and factors, or the same value in fewer
operations.
"""

from __future__ import annotations

import ast

import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    Point,
    System,
    Vector,
    cos,
    cost,
    functions_of_time,
    gibbs_appell,
    ground,
    kane,
    lagrange_equations,
    newton_euler,
    parse,
    rotate,
    simplify,
    sin,
    symbols,
    translate,
)
from symbody.symbolic import t

FORMALISMS = (newton_euler, lagrange_equations, kane, gibbs_appell)
m, m1, m2, l, l1, l2, lc1, lc2, I1, I2, g, A, C, M, R, Omega = PARAMETERS = symbols(
    "m m1 m2 l l1 l2 lc1 lc2 I1 I2 g A C M R Omega"
)
theta, phi, psi, theta1, theta2, q1, q2, x = COORDINATES = functions_of_time(
    "theta phi psi theta1 theta2 q1 q2 x"
)
NAMES = {str(name): name for name in (*PARAMETERS, *COORDINATES)}


def tree(text: str) -> object:
    """Return a text's sums and products flattened and sorted: what it says, without the order of terms."""
    return _tree(ast.parse(text.replace("'", "_dot"), mode="eval").body)


def _tree(node: ast.expr) -> object:
    for operators, signs in (((ast.Add, ast.Sub), ("+", "-")), ((ast.Mult, ast.Div), ("*", "/"))):
        if isinstance(node, ast.BinOp) and isinstance(node.op, operators):
            terms: list[tuple[str, object]] = []
            _gather(node, operators, signs, inverted=False, into=terms)
            return ("".join(signs), tuple(sorted(terms, key=repr)))
    return ast.dump(node) if isinstance(node, ast.Name | ast.Constant) else _operation(node)


def _gather(
    node: ast.expr,
    operators: tuple[type[ast.operator], type[ast.operator]],
    signs: tuple[str, str],
    *,
    inverted: bool,
    into: list[tuple[str, object]],
) -> None:
    if isinstance(node, ast.BinOp) and isinstance(node.op, operators):
        _gather(node.left, operators, signs, inverted=inverted, into=into)
        second = inverted != isinstance(node.op, operators[1])
        _gather(node.right, operators, signs, inverted=second, into=into)
    else:
        into.append((signs[inverted], _tree(node)))


def _operation(node: ast.expr) -> object:
    children = tuple(_tree(child) for child in ast.iter_child_nodes(node) if isinstance(child, ast.expr))
    operator = getattr(node, "op", None)
    return (type(node).__name__, type(operator).__name__, children)


def assert_textbook(derived: Expr, textbook: str) -> None:
    expected = parse(textbook, NAMES)
    assert derived == expected
    simplified = simplify(derived)
    assert simplified == expected
    assert cost(simplified).total <= cost(expected).total
    if cost(simplified).total == cost(expected).total:
        assert tree(str(simplified)) == tree(textbook), str(simplified)


def double_pendulum() -> System:
    elbow = rotate("Z", theta1) * translate(l1, 0, 0)
    tip = elbow * rotate("Z", theta2 - theta1) * translate(l2, 0, 0)
    gravity = Vector(ground, 0, -g, 0)
    return System(bodies=[Body(elbow, m1), Body(tip, m2)], coordinates=[theta1, theta2], gravity=gravity)


def two_link_arm() -> System:
    first = rotate("Z", q1)
    second = first * translate(l1, 0, 0) * rotate("Z", q2)
    bodies = [
        Body(Point(first, lc1, 0, 0), m1, 0, 0, I1),
        Body(Point(second, lc2, 0, 0), m2, 0, 0, I2),
    ]
    return System(bodies=bodies, coordinates=[q1, q2], gravity=Vector(ground, 0, -g, 0))


def spherical_pendulum() -> System:
    bob = rotate("Z", phi) * rotate("Y", theta) * translate(0, 0, l)
    return System(bodies=[Body(bob, m)], coordinates=[phi, theta], gravity=Vector(ground, 0, 0, g))


def cart_pole() -> System:
    cart = translate(x, 0, 0)
    bob = cart * rotate("Z", theta) * translate(0, -l, 0)
    gravity = Vector(ground, 0, -g, 0)
    return System(bodies=[Body(cart, M), Body(bob, m)], coordinates=[x, theta], gravity=gravity)


def heavy_top() -> System:
    top = rotate("Z", phi) * rotate("X", theta) * rotate("Z", psi)
    body = Body(Point(top, 0, 0, l), m, A, A, C)
    return System(bodies=[body], coordinates=[phi, theta, psi], gravity=Vector(ground, 0, 0, -g))


def hoop() -> System:
    bead = rotate("Z", Omega * t) * rotate("Y", theta) * translate(0, 0, -R)
    return System(bodies=[Body(bead, m)], coordinates=[theta], gravity=Vector(ground, 0, 0, -g))


MASS_MATRICES = {
    double_pendulum: (("(m1 + m2)*l1**2", "l1*l2*m2*cos(theta1 - theta2)"), (None, "l2**2*m2")),
    two_link_arm: (
        ("m1*lc1**2 + m2*(l1**2 + lc2**2 + 2*l1*lc2*cos(q2)) + I1 + I2", "m2*(lc2**2 + l1*lc2*cos(q2)) + I2"),
        (None, "m2*lc2**2 + I2"),
    ),
    spherical_pendulum: (("l**2*m*sin(theta)**2", "0"), (None, "l**2*m")),
    cart_pole: (("M + m", "l*m*cos(theta)"), (None, "l**2*m")),
    heavy_top: (
        ("(A + l**2*m)*sin(theta)**2 + C*cos(theta)**2", "0", "C*cos(theta)"),
        (None, "A + l**2*m", "0"),
        (None, None, "C"),
    ),
    hoop: (("R**2*m",),),
}

RESIDUALS = {
    double_pendulum: (
        """l1*((m1 + m2)*(l1*theta1'' + g*cos(theta1))
            + l2*m2*(theta2''*cos(theta1 - theta2) + theta2'**2*sin(theta1 - theta2)))""",
        """l2*m2*(l2*theta2'' + g*cos(theta2)
            + l1*(theta1''*cos(theta1 - theta2) - theta1'**2*sin(theta1 - theta2)))""",
    ),
    spherical_pendulum: (
        "l**2*m*sin(theta)*(phi''*sin(theta) + 2*phi'*theta'*cos(theta))",
        "l*m*(l*theta'' + sin(theta)*(g - l*phi'**2*cos(theta)))",
    ),
    cart_pole: (
        "(M + m)*x'' + l*m*(theta''*cos(theta) - theta'**2*sin(theta))",
        "l*m*(l*theta'' + x''*cos(theta) + g*sin(theta))",
    ),
    hoop: ("R*m*(R*theta'' + sin(theta)*(g - R*Omega**2*cos(theta)))",),
}


@pytest.mark.parametrize("formalism", FORMALISMS)
@pytest.mark.parametrize("system", MASS_MATRICES)
def test_mass_matrices(system: type[System], formalism: type[Equations]) -> None:
    derived = formalism(system()).mass_matrix
    for i, row in enumerate(MASS_MATRICES[system]):
        for j, textbook in enumerate(row):
            assert derived[i, j] == derived[j, i]
            if textbook is not None:
                assert_textbook(derived[i, j], textbook)


@pytest.mark.parametrize("formalism", FORMALISMS)
@pytest.mark.parametrize("system", RESIDUALS)
def test_equations_of_motion(system: type[System], formalism: type[Equations]) -> None:
    """Hold the length to the textbook's; factored forms differ too much from book to book to compare texts."""
    for residual, textbook in zip(formalism(system()).residuals, RESIDUALS[system], strict=True):
        expected = parse(textbook, NAMES)
        simplified = simplify(residual)
        assert simplified == residual == expected
        assert cost(simplified).total <= cost(expected).total, str(simplified)


def test_the_entry_of_the_double_pendulum_is_printed_as_in_the_book() -> None:
    mass_matrix = lagrange_equations(double_pendulum()).mass_matrix
    assert str(simplify(mass_matrix[0, 1])) == "l1*l2*m2*cos(theta1 - theta2)"


@pytest.mark.parametrize("names", ["q1 q2", "alpha beta", "phi1 phi2", "a2 a3", "u v", "phi psi"])
def test_differences_are_written_in_the_order_of_names(names: str) -> None:
    first, second = functions_of_time(names)
    difference = names.replace(" ", " - ")
    assert str(simplify(cos(first) * cos(second) + sin(first) * sin(second))) == f"cos({difference})"
    assert str(simplify(sin(first) * cos(second) - cos(first) * sin(second))) == f"sin({difference})"
    assert str(cos(second - first)) == f"cos({difference})"


def test_conserved_momenta_of_the_heavy_top() -> None:
    """The equation of the spin is the rate of C*(psi' + phi'*cos(theta)), the total spin's momentum."""
    spin = lagrange_equations(heavy_top()).residuals[2]
    momentum = parse("C*(psi' + phi'*cos(theta))", NAMES)
    assert spin == momentum.diff(t)
    assert (
        cost(simplify(spin)).total
        <= cost(parse("C*(psi'' + phi''*cos(theta) - phi'*theta'*sin(theta))", NAMES)).total
    )


def test_constant_sines_disappear() -> None:
    """A planar chain of four links: its mass matrix holds no angle but differences."""
    angles = functions_of_time("a1 a2 a3 a4")
    frame, bodies = ground, []
    for k, angle in enumerate(angles):
        frame = frame * rotate("Z", angle - (angles[k - 1] if k else 0)) * translate(l, 0, 0)
        bodies.append(Body(frame, m))
    system = System(bodies=bodies, coordinates=angles, gravity=Vector(ground, 0, -g, 0))
    derived = lagrange_equations(system).mass_matrix
    for i in range(4):
        for j in range(4):
            links = 4 - max(i, j)
            difference = f"a{min(i, j) + 1} - a{max(i, j) + 1}"
            factor = f"{links}*" if links > 1 else ""
            expected = f"{factor}l**2*m*cos({difference})" if i != j else f"{factor}l**2*m"
            simplified = simplify(derived[i, j])
            assert tree(str(simplified)) == tree(expected), str(simplified)
