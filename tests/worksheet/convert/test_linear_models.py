"""Programs of linear models: tyres keep the first order, and functions that are given later are known everywhere."""

from __future__ import annotations

from typing import Any

import pytest

import symbody as sb
from symbody.worksheet.convert.program import Converted, converted
from symbody.worksheet.reading.files import source_cells

pytestmark = pytest.mark.filterwarnings("ignore::symbody.errors.ModelNotice")
"""Other tests of this process use the names of these sheets for other things."""


def made(sheet: str) -> tuple[Converted, dict[str, Any]]:
    """Return the program of a sheet, which is all code, and its variables after a run."""
    program = converted(source_cells(f"with(MBSymba_r6): {sheet}"), "model")
    assert (program.values, program.left_out, program.failed) == (0, 0, 0)
    values: dict[str, Any] = {}
    exec(program.text, values)
    return program, values


def test_a_steered_wheel_with_rake_slips_and_leans_as_by_hand() -> None:
    """The steering axis meets the road at the contact; the wheel turns by delta cos(epsilon) and leans by the rest."""
    program, values = made(
        "linear_modeling({y(t),psi(t),delta(t),Y(t)}): x(t) := V*t: diff(theta(t),t) := V/R: theta(t) := V*t/R: "
        "T := translate(x(t),y(t),0)*rotate('Z',psi(t))*rotate('Y',epsilon)*rotate('Z',delta(t))*rotate('Y',-epsilon): "
        "wheel := make_BODY(T*translate(0,0,-R)*rotate('Y',-theta(t)), 0, 0, i, 0): "
        "tyre := make_TIRE(wheel,0,0,0,0,R,0,Y(t),-N,0,0,0,ground): F, M := tire_forces(tyre): "
        "C, VS, VN, VR := tire_kinematics(tyre): slip := linearize(-arctan(VN/VS)): load := comp_Y(F):"
    )
    assert "tyre_axes = tire_frame(wheel.frame, sb.ground)\n" in program.text
    y, psi, delta, load = (values[each] for each in ("y", "psi", "delta", "Y"))
    V, N, epsilon = sb.symbols("V N epsilon")
    assert values["slip"] == psi + delta * sb.cos(epsilon) - sb.diff(y, sb.t) / V
    assert values["load"] == load - N * delta * sb.sin(epsilon)


def test_a_velocity_of_the_moving_frame_that_is_given_later_is_that_of_what_was_made_before() -> None:
    _, values = made(
        "use_moving_frame(u(t),v(t),0,0,0,r(t)): B := make_BODY(moving_frame,m,0,0,J): "
        "a, b := comp_X(velocity(CoM(B))), u(t)*k: slip := b/a: u(t) := V: half := slip/2: N := newton_equations({B}):"
    )
    V, m, k = sb.symbols("V m k")
    r, v = sb.functions_of_time("r v")
    assert (values["slip"], values["half"]) == (k, k / 2)
    assert values["N"].components[1] == m * (sb.diff(v, sb.t) + V * r)


def test_values_in_linear_models_contain_the_small_variables_of_the_program() -> None:
    program = converted(
        source_cells(
            "with(MBSymba_r6): linear_modeling({q(t) = a}): w := subsop(1 = b, sin(q(t)) + q(t)*k):"
        ),
        "model",
    )
    assert program.values == 1
    assert "q = a + sb.small(q)  # results print the deviation as q\n" in program.text
    assert "functions_of_time" not in program.text.partition("small")[2]


def test_a_load_on_the_ground_with_its_reaction_is_the_opposite_load_on_the_body() -> None:
    """The rule of y is given where its argument is the time."""
    program, values = made(
        "`diff/y` := proc(a) if a = t then u(t) else 0 end if end proc: B := make_BODY(translate(0,y(t),0),m): "
        "F := make_FORCE(ground,0,f,0,CoM(B),ground,B): G := make_TORQUE(make_VECTOR(ground,g,0,0),ground,B): "
        "N := newton_equations({B,F}): K := kinetic_energy(B): E := euler_equations({B,G},CoM(B)):"
    )
    assert "F = sb.Force(sb.ground, 0, -f, 0, at=B.center_of_mass, on=B)\n" in program.text
    m, f, g, u = (values[each] for each in "mfgu")
    assert values["K"] == m * u**2 / 2
    assert values["N"].components[1] == m * sb.diff(u, sb.t) + f
    assert values["E"].components[0] == g
