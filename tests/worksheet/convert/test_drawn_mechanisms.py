"""Loops that move a mechanism and draw it: what depends on its angle is built again, and pictures are shapes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from symbody.worksheet.convert.definitions import DEFINITIONS, needed_definitions
from symbody.worksheet.convert.program import Converted, converted
from symbody.worksheet.reading.files import source_cells

pytestmark = pytest.mark.filterwarnings("ignore::symbody.errors.ModelNotice")
"""Other tests of this process use the names of these sheets for other things."""

CRANK = """
restart: with(MBSymba_r6): with(plots): with(plottools):
A := make_POINT(rotate('Z', beta), r, 0, 0):
beta := 2*alpha: r := 0.5:
for k from 0 to 3 do
  alpha := evalf(k*Pi/8);
  tip[k] := [comp_X(A, ground), comp_Y(A, ground)];
  frame[k] := display({line([0,0], tip[k], color=red), disk(tip[k], 0.1), polygon([[0,0],[1,0],[0,1]])});
end do:
display([seq(frame[k], k = 0..3)], insequence = true, scaling = constrained);
display(frame[1], rectangle([0,0],[1,2]), point([3,4]));
plot([[0,0],[1,2]], color = blue);
"""


def made(sheet: str) -> tuple[Converted, dict[str, Any]]:
    """Return the program of a sheet, and its variables after a run; what it shows is not shown."""
    program = converted(source_cells(sheet), "mechanism")
    values: dict[str, Any] = {}
    exec(program.text.replace("plt.show()", ""), values)
    return program, values


def test_a_crank_that_is_moved_by_a_loop_is_drawn() -> None:
    program, values = made(CRANK)
    assert (program.values, program.left_out, program.failed) == (0, 0, 0)
    for k in range(4):
        tip = [0.5 * math.cos(k * math.pi / 4), 0.5 * math.sin(k * math.pi / 4)]
        assert np.array(values["tip"][k], dtype=float) == pytest.approx(tip, abs=1e-12)
        rod, disk, triangle = (np.array(each, dtype=float) for each in values["frame"][k])
        assert rod == pytest.approx(np.array([[0, 0], tip]), abs=1e-12)
        assert np.hypot(*(disk - tip).T) == pytest.approx(0.1)
        assert triangle.tolist() == [[0, 0], [1, 0], [0, 1], [0, 0]]
    assert "    beta = 2*alpha\n    A = sb.Point(" in program.text
    assert "animation = animate([frame[k] for k in range(0, 4)])\n" in program.text
    assert (
        "draw([*frame[1], rectangle([0, 0], [1, 2]), [[3, 4]]])\ndraw([[[0, 0], [1, 2]]])\n" in program.text
    )
    assert program.text.endswith("plt.show()\n")


def test_a_program_contains_the_functions_that_it_calls_and_no_others() -> None:
    assert list(needed_definitions("draw(p)")) == [
        DEFINITIONS[each] for each in ("lines_in", "axes_of", "draw")
    ]
    assert list(needed_definitions("x.draw(p)")) == []


def test_eigenvalues_of_symbols_are_solutions_of_the_determinant() -> None:
    program, values = made(
        "K := Matrix([[2*k,-k],[-k,k]]): M := Matrix([[2*m,0],[0,m]]): ev := LinearAlgebra[Eigenvalues](K, M):"
    )
    assert "ev = eigenvalues(K, M)\n" in program.text
    at = {values["k"]: 3, values["m"]: 2}
    expected = np.linalg.eigvals(np.linalg.inv([[4, 0], [0, 2]]) @ np.array([[6, -3], [-3, 3]]))
    assert sorted(each.evaluate(at) for each in values["ev"]) == pytest.approx(sorted(expected))


@pytest.mark.parametrize(
    ("turned", "loop"),
    [("phi(t)", "sb.simplify(loop)"), ("phi(t)-theta(t)", "loop")],
    ids=["to the crank", "back"],
)
def test_solutions_of_loops_are_those_of_the_simplified_equations(turned: str, loop: str) -> None:
    """Angles to the body before are added by simplify; a chain that turns back has the sums of its angles at once."""
    program, _ = made(
        f"restart: with(MBSymba_r6): T := rotate('Z',theta(t))*translate(r,0,0)*rotate('Z',{turned}):\n"
        "P := make_POINT(T,l,0,0): loop := {comp_X(P,ground) = s(t), comp_Y(P,ground) = 0}:\n"
        "sol := allvalues(solve(loop, {phi(t), s(t)})): both := solve(loop, {phi(t), s(t)}):"
    )
    assert program.values == 0
    assert program.text.count(f"sb.solutions({loop}, [phi, s])") == 2


def test_the_vector_of_a_force_and_several_arguments_of_a_format(capsys: pytest.CaptureFixture[str]) -> None:
    program, _ = made(
        "restart: with(MBSymba_r6): B := make_BODY(translate(l,0,0), m): F := make_FORCE(ground,0,F0,0,CoM(B),B):\n"
        "M := cross_prod(join_points(origin(ground), CoM(B)), F): comp_Z(M); f := x -> (x/2, x^2):\n"
        'for j to 2 do printf("%d %5.2f %5.2f|", j, f(j)) end do; printf("%4.1f %d\\n", op([1/2, 3]));'
    )
    assert program.values == 0
    assert capsys.readouterr().out == "F0*l\n1  0.50  1.00|2  1.00  4.00| 0.5 3\n"
    assert "F.vector" in program.text
