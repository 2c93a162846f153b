"""Embedded equations by velocity ratios: mechanisms read as Eksergian's equation, and the values are theirs."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    System,
    cos,
    describe,
    embedded,
    functions_of_time,
    latex,
    newton_euler,
    parse,
    report,
    rotate,
    sin,
    subs,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.models import ClassicSystem, andrews_mechanism, four_bar, slider_crank
from symbody.symbolic import free_symbols

r, b, m, M, J, I, F = symbols("r b m M J I F")
phi = functions_of_time("phi")


def crank_slider(names: str = "phi psi s") -> Equations:
    """Return the equation of a crank with a massless rod and a piston, by its angle."""
    first, second, slide = functions_of_time(names)
    crank, piston = Body(rotate("Z", first), 0, Iz=J), Body(translate(slide, 0, 0), m)
    closed = [r * cos(first) + b * cos(second) - slide, r * sin(first) + b * sin(second)]
    system = System([crank, piston], coordinates=[first, second, slide], constraints=closed)
    return embedded(newton_euler(system), [time_derivative(first)])


def rows(equations: Equations) -> list[str]:
    """Return what is shown, a text for each quantity, equation and rate."""
    return [" ".join(row.split()) for row in re.split(r"\n    (?! )", describe(equations))[1:]]


def residuals(equations: Equations) -> list[Expr]:
    """Return the equations that are shown, by the independent speeds and without names."""
    system = equations.system
    names = {leaf.name: leaf for leaf in system.leaves}
    names |= {each.name: each for each in system.coordinates}
    found = list[Expr]()
    for row in rows(equations):
        if " := " in row:
            name, right = row.split(" := ")
            names[name] = system.by_speeds([parse(right, names)])[0]
            names[f"{name}_rate"] = system.rate([names[name]])[0]
        elif not row.startswith(("constraint", "kinematics")):
            left, right = re.sub(r"\b([lf])'", r"\1_rate", row).split(" = ")
            found.append(parse(left, names) - parse(right, names))
    return [*system.by_speeds(found)]


def test_a_slider_crank_is_eksergians_equation() -> None:
    """As in Doughty, Mechanics of Machines, 1988, ch. 6: K is a velocity coefficient, L its derivative."""
    assert rows(crank_slider()) == [
        "K_psi := -r*cos(phi)/(b*cos(psi))",
        "K_s := -r*sin(phi - psi)/cos(psi)",
        "L_psi := (K_psi**2*sin(psi) + r*sin(phi)/b)/cos(psi)",
        "L_s := -b*(K_psi**2*cos(psi) + L_psi*sin(psi)) - r*cos(phi)",
        "(J + m*K_s**2)*phi'' + m*K_s*L_s*phi'**2 = 0",
        "constraint: b*cos(psi) + r*cos(phi) - s = 0",
        "constraint: b*sin(psi) + r*sin(phi) = 0",
        "kinematics: psi' = K_psi*phi'",
        "kinematics: psi'' = K_psi*phi'' + L_psi*phi'**2",
        "kinematics: s' = K_s*phi'",
        "kinematics: s'' = K_s*phi'' + L_s*phi'**2",
    ]


@pytest.mark.parametrize("model", [slider_crank, four_bar])
def test_rows_by_velocity_ratios_are_the_equations(model: Callable[[], ClassicSystem]) -> None:
    equations = embedded(newton_euler(model().system))
    assert any(row.startswith("K_") for row in rows(equations))
    assert residuals(equations) == [*equations.residuals]


def test_a_mechanism_of_six_loops_is_written_out() -> None:
    equations = embedded(newton_euler(andrews_mechanism().system))
    shown = rows(equations)
    assert equations.is_readable
    assert not any("/beta'" in row for row in shown)
    assert sum(row.startswith(("K_", "L_")) for row in shown) == 2 * len(equations.system.eliminated)


def five_bar() -> Equations:
    """Return the equations of two cranks of equal lengths whose rods meet in a joint, in the angles of the cranks."""
    angles = functions_of_time("alpha beta gamma delta")
    first, second, third, fourth = angles
    bodies = [
        Body(rotate("Z", angle), 0, Iz=inertia) for angle, inertia in zip(angles, (I, J, m, M), strict=True)
    ]
    closed = [
        r * cos(first) + b * cos(second) - r * cos(third) - b * cos(fourth) - F,
        r * sin(first) + b * sin(second) - r * sin(third) - b * sin(fourth),
    ]
    system = System(bodies, coordinates=angles, constraints=closed)
    return embedded(newton_euler(system), [time_derivative(first), time_derivative(third)])


def test_ratios_to_several_speeds_name_them() -> None:
    equations = five_bar()
    shown = rows(equations)
    assert shown[0] == "K_beta_alpha := -r*sin(alpha - delta)/(b*sin(beta - delta))"
    assert "kinematics: beta' = K_beta_alpha*alpha' + K_beta_gamma*gamma'" in shown
    assert residuals(equations) == [*equations.residuals]


def test_names_of_the_model_are_not_taken() -> None:
    stiff = symbols("K")
    first, slide = functions_of_time("phi s")
    crank, piston = Body(rotate("Z", first), 0, Iz=stiff), Body(translate(slide, 0, 0), m)
    closed = (slide - r * cos(first)) ** 2 + (r * sin(first)) ** 2 - b**2
    system = System([crank, piston], coordinates=[first, slide], constraints=[closed])
    shown = rows(embedded(newton_euler(system), [time_derivative(first)]))
    assert shown[0].startswith("kappa_s := ")
    assert "(K + m*kappa_s**2)*phi''" in shown[2]


def test_numbers_keep_the_form() -> None:
    shown = rows(subs(crank_slider(), {r: 2, b: 5}))
    assert "(J + m*K_s**2)*phi'' + m*K_s*L_s*phi'**2 = 0" in shown


def test_values_have_no_such_names() -> None:
    equations = crank_slider()
    form = equations.matrix_form()
    assert form.mass_matrix == equations.mass_matrix
    assert not any(leaf.name.startswith(("K_", "L_")) for leaf in free_symbols(form.mass_matrix.entries))


def test_latex_and_a_page_of_one_equation_have_them() -> None:
    equations = crank_slider()
    assert r"\left(J + m K_{s}^{2}\right) \ddot{\phi}" in latex(equations)
    one = describe(equations.equation_of(phi))
    assert "K_s := -r*sin(phi - psi)/cos(psi)" in one
    assert one.endswith(
        "constraint: b*cos(psi) + r*cos(phi) - s = 0\n    constraint: b*sin(psi) + r*sin(phi) = 0"
    )
    assert r"&b \sin(\psi) + r \sin(\phi) = 0" in latex(equations.equation_of(phi))


def driven_slider(*, is_driven: bool) -> Equations:
    """Return the equation of a crank with a massless rod and a piston; the crank's bearing may move in a given way."""
    first, second, slide, bearing = functions_of_time("phi psi s x")
    crank, piston = Body(rotate("Z", first), 0, Iz=J), Body(translate(slide, 0, 0), m)
    closed = [
        bearing + r * cos(first) + b * cos(second) - slide,
        r * sin(first) + b * sin(second),
        bearing - (r * sin(M * t) + r * cos(2 * M * t) if is_driven else 0),
    ]
    system = System([crank, piston], coordinates=[first, second, slide, bearing], constraints=closed)
    return embedded(newton_euler(system), [time_derivative(first)])


def test_what_the_time_brings_is_added_to_the_ratios() -> None:
    """As Kane's B_r: ``u_r = sum of A_rs u_s + B_r``; the ratios are those of the resting bearing."""
    equations = driven_slider(is_driven=True)
    driven, resting = rows(equations), rows(driven_slider(is_driven=False))
    assert (
        driven[:2]
        == resting[:2]
        == [
            "K_psi := -r*cos(phi)/(b*cos(psi))",
            "K_s := -r*sin(phi - psi)/cos(psi)",
        ]
    )
    assert "kinematics: s' = K_s*phi' + B_x" in driven
    assert "constraint: x - r*sin(M*t) - r*cos(2*M*t) = 0" in driven
    assert residuals(equations) == [*equations.residuals]


def test_conditions_that_no_row_needs_are_not_shown() -> None:
    """As of a cart with a wheel: the place of the cart follows from the angle, and no row depends on it."""
    angle, place = functions_of_time("phi x")
    bodies = [Body(rotate("Z", angle), 0, Iz=J), Body(translate(place, 0, 0), m)]
    cart = System(bodies, coordinates=[angle, place], constraints=[place - r * angle])
    assert rows(embedded(newton_euler(cart), [time_derivative(angle)])) == [
        "(J + m*r**2)*phi'' = 0",
        "kinematics: x' = r*phi'",
    ]


def test_a_mechanism_without_quotients_is_written_out() -> None:
    """A Scotch yoke has no dead centre: ``K_s = -r sin(phi)`` needs no name."""
    angle, slide = functions_of_time("phi s")
    crank, yoke = Body(rotate("Z", angle), 0, Iz=J), Body(translate(slide, 0, 0), m)
    system = System([crank, yoke], coordinates=[angle, slide], constraints=[slide - r * cos(angle)])
    assert rows(embedded(newton_euler(system), [time_derivative(angle)])) == [
        "(J + m*r**2*sin(phi)**2)*phi'' + m*r**2*sin(phi)*cos(phi)*phi'**2 = 0",
        "kinematics: s' = -r*sin(phi)*phi'",
    ]


def test_divisors_of_names_are_short() -> None:
    """The slotted lever of a shaper: L was divided by ``s*sin(phi)**2 + s*cos(phi)**2``, which is s."""
    crank, lever, slide = functions_of_time("theta phi s")
    bodies = [Body(rotate("Z", crank), 0, Iz=I), Body(rotate("Z", lever), 0, Iz=J)]
    closed = [r * cos(crank) - slide * cos(lever), r * sin(crank) + b - slide * sin(lever)]
    shaper = System(bodies, coordinates=[crank, lever, slide], constraints=closed)
    equations = embedded(newton_euler(shaper), [time_derivative(crank)])
    assert rows(equations)[0] == "K_phi := r*cos(theta - phi)/s"
    assert "L_phi := -(2*K_phi*K_s + r*sin(theta - phi))/s" in rows(equations)
    assert residuals(equations) == [*equations.residuals]


def test_short_equations_have_none() -> None:
    """As of a bead whose height its place gives: `m*(1 + x**2/y**2)*x''` needs no name."""
    place, height = functions_of_time("x y")
    bead = System(
        [Body(translate(place, height, 0), m)],
        coordinates=[place, height],
        constraints=[place**2 + height**2 - r**2],
    )
    assert rows(embedded(newton_euler(bead), [time_derivative(place)])) == [
        "m*(1 + x**2/y**2)*x'' + m*x*(x**2 + y**2)*x'**2/y**4 = 0",
        "constraint: x**2 + y**2 - r**2 = 0",
        "kinematics: y' = -x*x'/y",
    ]


def test_a_report_has_the_short_form_of_rates(tmp_path: Path) -> None:
    """What the constraints give was written as their solution: wider than a page."""
    report(crank_slider(), tmp_path / "crank.md")
    text = (tmp_path / "crank.md").read_text(encoding="utf-8")
    assert r"\dot{\psi} &= -\frac{r \cos(\phi) \dot{\phi}}{b \cos(\psi)}" in text
    assert "The constraints on positions, which the equations satisfy, are" in text
    assert (
        r"\dot{s} &= -\frac{r \sin(\phi - \psi) \dot{\phi}}{\cos(\psi)}" in text
    )  # in the coordinates' order


def six_bar() -> Equations:
    """Return a crank and rocker that drives a slider by a second coupler; all bars are rods."""
    lengths, masses = symbols("a b c e"), symbols("mA mB mC mD")
    d, slider = symbols("d mE")
    (*angles, s) = functions_of_time("q1 q2 q3 q4 s")
    tips = [(l * cos(q), l * sin(q)) for l, q in zip(lengths, angles, strict=True)]
    starts = [(0, 0), tips[0], (d, 0), (d + tips[2][0], tips[2][1])]
    bodies = [
        Body(translate(*at, 0) * rotate("Z", q) * translate(l / 2, 0, 0), each, Iz=each * l**2 / 12)
        for at, q, l, each in zip(starts, angles, lengths, masses, strict=True)
    ]
    loops = [
        *(tips[0][k] + tips[1][k] - starts[2][k] - tips[2][k] for k in (0, 1)),
        *(starts[3][k] + tips[3][k] - (s, 0)[k] for k in (0, 1)),
    ]
    bodies.append(Body(translate(s, 0, 0), slider))
    system = System(bodies, coordinates=[*angles, s], constraints=loops)
    return embedded(newton_euler(system), [time_derivative(angles[0])])


def test_the_terms_of_one_coupling_stand_in_one_bracket() -> None:
    equations = six_bar()
    row = next(each for each in rows(equations) if "q1''" in each)
    for coupling in ("c*e*mD*", "a*b*mB*"):
        accelerations, velocities = row.split("*q1''")
        assert accelerations.count(coupling) == velocities.count(coupling) == 1
    assert tuple(residuals(equations)) == equations.derived_residuals
