"""Forces of MBSymba's commands: at the points that were meant."""

from __future__ import annotations

from symbody.worksheet.interpreter.interpret import Interpreter
from tests.worksheet.printed_by import printed

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
