"""Forces of MBSymba's commands: at the points that were meant."""

from __future__ import annotations

import pytest

from symbody.worksheet.interpreter.interpret import Interpreter
from tests.worksheet.printed_by import failures, printed

SLIDER = """
with(MBSymba_r6):
T1 := translate(x(t), 0, 0)*rotate('Z', phi(t)):
b := make_BODY(T1, m, 0, 0, Iz):
"""


def notices(force: str, members: str = "b, F") -> list[str]:
    interpreter = Interpreter()
    printed(f"{SLIDER}{force}\nnewton_equations({{{members}}});", interpreter=interpreter)
    return interpreter.session.notices


def test_a_force_at_a_point_that_its_body_leaves_is_told() -> None:
    at = "make_POINT({}, 1, 0, 0)"
    there = f"F := make_FORCE(ground, 0, F0, 0, {at.format('ground')}, b):"
    assert notices(there) == [
        (
            "newton_equations: the force F acts on b at a place at rest, from which the body moves away; expected a "
            "point of the body: make_POINT with its frame; if the force shall stay there, give the body that exerts it "
            "as the last argument of make_FORCE"
        )
    ]
    assert notices(there.replace("ground, 1", "T1, 1")) == []
    jet = "J := make_BODY(ground, 1, 0, 0, 0):\n" + there.replace(", b):", ", b, J):")
    assert notices(jet, "b, J, F") == []


@pytest.mark.parametrize("slope", ["", "rotate('Y',e)*"])
def test_a_road_frame_that_goes_with_the_car_is_a_plane_at_rest(slope: str) -> None:
    sheet = (
        f"TR := {slope}translate(x(t),y(t),0)*rotate('Z',psi(t)): TW := TR*rotate('X',phi(t))*translate(0,0,-R): "
        "W := make_BODY(TW*rotate('Y',theta(t)),m,Id,Ia,Id): make := T -> make_TIRE(W,0,0,0,0,rr(t),X,Y,-N,0,0,0,T): "
        f"moving := [tire_kinematics(make(TR))]: fixed := [tire_kinematics(make({slope}translate(0,0,0)))]: "
        "seq(simplify(moving[i]-fixed[i]), i=2..4); subs(phi(t)=0, moving[2]);"
    )
    assert printed(sheet) == ["0, 0, 0", "cos(psi(t))*diff(x(t),t)+sin(psi(t))*diff(y(t),t)"]


TYRE = """
with(MBSymba_r6): with(MBSymba_r6_tire):
hub := translate(x(t), 0, -h)*rotate('Z', delta(t))*rotate('X', phi(t)):
wheel := make_BODY(hub*rotate('Y', theta(t)), m, Jd, Ja, Jd):
"""


def told(tyre: str, statement: str) -> tuple[list[str], list[str]]:
    interpreter = Interpreter()
    lines = printed(f"{TYRE}tire := make_TIRE(wheel{tyre}):\n{statement}", interpreter=interpreter)
    return lines, interpreter.session.notices


def test_a_tyre_among_bodies_is_told_to_be_no_load() -> None:
    _, notices = told(", 0, R, 0, 0, 0, X, Y, -N", "newton_equations({wheel, tire}):")
    assert notices == [
        (
            "newton_equations: the tyre tire is left out, because it is no load; expected its force and torque, "
            "tire_forces(tire), in the set"
        )
    ]


def test_a_tyre_without_a_radius_is_told() -> None:
    assert told(", 0, 0, 0, 0, R", "")[1] == []
    assert told(", 0, 0", "")[1] == [
        (
            "make_TIRE: the radius z + z_def is zero, so that the tyre touches the road at the centre of the wheel; "
            "expected the distance from there to the contact, such as make_TIRE(wheel, 0, R, 0, 0, 0, X, Y, -N)"
        )
    ]


def test_the_lateral_velocity_of_a_cambered_tyre_is_short() -> None:
    """The spin, which moves the contact ahead alone, is not in it."""
    lines, _ = told(", rho*sin(phi(t)), R-rho+rho*cos(phi(t))", "tire_kinematics(tire)[3];")
    assert "theta" not in lines[-1]
    assert len(lines[-1]) < 120


def test_a_force_whose_point_has_no_value() -> None:
    text = (
        "with(MBSymba_r6): b := make_BODY(translate(x(t),0,0), m): P := origin(b[frame]): "
        "F := make_FORCE(make_VECTOR(ground,X,0,0), P, b): unassign('P'): newton_equations({b, F});"
    )
    (message,) = failures(text)
    assert message == (
        "newton_equations: the force F is applied at P, which has no value; expected a point: save it with the force, "
        "or assign it first"
    )


def test_a_force_in_a_table_is_told_by_its_entry() -> None:
    text = (
        "with(MBSymba_r6): b[1] := make_BODY(translate(x(t),0,0), m): c := make_BODY(ground, m): "
        "F[2] := make_FORCE(make_VECTOR(ground,X,0,0), origin(b[1][frame]), b[1]): newton_equations({c, F[2]}):"
    )
    assert printed(text)[-1] == "<F[2]> FORCE is not valid: it must be applied to a BODY"


def test_the_ground_is_shown_by_its_name_as_the_body_on_which_a_force_acts() -> None:
    assert printed(
        "with(MBSymba_r6): b := make_BODY(ground,m): show(make_TORQUE(ground,1,0,0,master_frame,b));"
    )[-1] == ("TORQUE(frame = ground,acting = ground,comps = Matrix([[1], [0], [0], [0]]),reacting = b)")
