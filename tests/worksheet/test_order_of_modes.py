"""The order in which a sheet begins its modes doesn't matter."""

from __future__ import annotations

import symbody as sb
from symbody.symbolic import Expr
from symbody.worksheet.interpreter.interpret import Interpreter
from tests.worksheet.printed_by import printed


def test_velocities_of_the_moving_frame_become_small() -> None:
    modes = "use_moving_frame(V, v(t), 0, 0, 0, r(t)):", "linear_modeling({v(t), r(t), phi(t)}):"
    model = (
        "b := make_BODY(rotate('X', phi(t)) * translate(a, 0, -h), m, Ix, Iy, Iz): "
        "N := newton_equations(b): x := comp_X(N): y := comp_Y(N): z := comp_Z(euler_equations(b, origin(ground))):"
    )
    sheets = Interpreter(), Interpreter()
    for sheet, order in zip(sheets, (modes, modes[::-1]), strict=True):
        printed(f"with(MBSymba_r6): {' '.join(order)} {model}", interpreter=sheet)
    for name in "xyz":
        first, second = (sheet.session.current(sheet.session.names[name]) for sheet in sheets)
        assert isinstance(first, Expr)
        assert first == second
    (v, r, phi), (V, m, a, h) = sb.functions_of_time("v r phi"), sb.symbols("V m a h")
    rate, by = sb.time_derivative, sheets[0].session
    assert by.current(by.names["x"]) == 0
    assert by.current(by.names["y"]) == m * (rate(v) + V * r + a * rate(r) + h * rate(phi, 2))


def test_rates_are_small_where_their_functions_are_not() -> None:
    """By hand: a point at a from the centre of a turn by psi, whose rate is small, has no centripetal acceleration."""
    text = (
        "with(MBSymba_r6): linear_modeling({diff(psi(t),t), y(t)}): B := make_BODY(make_POINT("
        "translate(0,y(t),0)*rotate('Z',psi(t)),a,0,0),m): N := newton_equations({B}): comp_X(N), comp_Y(N), "
        "linearize(b*diff(psi(t),t) + diff(psi(t),t)^2*sin(psi(t)) + diff(psi(t),t)*y(t));"
    )
    turn, rise = "diff(psi(t),`$`(t,2))", "diff(y(t),`$`(t,2))"
    by_hand = f"-a*m*sin(psi(t))*{turn}, m*(a*cos(psi(t))*{turn}+{rise}), b*diff(psi(t),t)"
    assert printed(text)[-1] == by_hand
    assert printed("linearize(diff(psi(t),t)^2, {diff(psi(t),t) = Omega});") == [
        "Omega^2+2*Omega*(diff(psi(t),t)-Omega)"
    ]
