"""Derivatives of all that holds scalars, and rules of the sheet."""

import pytest

from tests.worksheet.printed_by import failures, printed

CASES = {
    "total": (
        "diff(m*x(t)^2,t);",
        ["2*m*x(t)*diff(x(t),t)"],
    ),
    "twice": (
        "diff(x(t)^2,t,t); diff(x(t),t$2);",
        ["2*diff(x(t),t)^2+2*x(t)*diff(x(t),`$`(t,2))", "diff(x(t),`$`(t,2))"],
    ),
    "by a function": (
        "diff(m*x(t)^2/2,x(t)), diff(diff(x(t),t)^2,diff(x(t),t));",
        ["m*x(t), 2*diff(x(t),t)"],
    ),
    "lists and matrices": (
        "diff([x(t),y(t)],t); map(diff,matrix([[x(t),1]]),t);",
        ["[diff(x(t),t), diff(y(t),t)]", "matrix([[diff(x(t),t), 0]])"],
    ),
    "an unknown function": (
        "diff(X(q),q); diff(f(x,y),y);",
        ["diff(X(q),q)", "diff(f(x,y),y)"],
    ),
    "D": (
        "D(sin)(0), D(f)(a), D(x)(t); g := u -> u^3: D(g)(2);",
        ["1, diff(f(a),a), diff(x(t),t)", "12"],
    ),
    "D of an operator whose parameter has a value": (
        "x := 5: f := x -> x^2*a: D(f)(y); g := unapply(z^2, z): z := 7: D(g)(u);",
        ["2*a*y", "2*u"],
    ),
    "D by places": (
        "D[1](g)(x,y), D[2](g)(a,b+c); D[1,2](g)(x,y);",
        ["diff(g(x,y),x), D[2](g)(a,b+c)", "diff(diff(g(x,y),x),y)"],
    ),
    "a rule of one argument": (
        (
            "`diff/theta` := proc(t) omega(t) end proc: diff(theta(t),t); diff(theta(t),t,t); "
            "diff(sin(theta(t)),t);"
        ),
        ["omega(t)", "diff(omega(t),t)", "cos(theta(t))*omega(t)"],
    ),
    "a rule of two arguments": (
        "`diff/f` := proc(a,x) g(a)*diff(a,x) end proc: diff(f(2*t),t);",
        ["2*g(2*t)"],
    ),
    "a rule of a function of two": (
        "`diff/h` := proc(a,b,x) a*diff(b,x) end proc: diff(h(u,v^2),v);",
        ["2*u*v"],
    ),
    "a rule that asks for its variable": (
        (
            "`diff/psi` := proc(a,b) if b = t then w(t) else 0 end if end proc: diff(psi(2*t),t); "
            "expand(diff(psi(2*t)*psi(t)^2,t,t)); comp_X(velocity(origin(translate(psi(2*t),0,0))));"
        ),
        [
            "w(t)",
            "2*psi(2*t)*psi(t)*diff(w(t),t)+4*psi(t)*w(t)^2+2*psi(2*t)*w(t)^2+psi(t)^2*diff(w(t),t)",
            "w(t)",
        ],
    ),
    "a rule is called with the argument": (
        "`diff/psi` := proc(a,b) omega(a) end proc: diff(sin(psi(2*t)),t); diff(psi(3*q),q);",
        ["cos(psi(2*t))*omega(2*t)", "omega(3*q)"],
    ),
    "by a place whose variable moves another one": (
        "diff(f(q(t),t),t); diff(f(x^2,x),x); diff(f(q(t),x),x);",
        [
            "D[1](f)(q(t),t)*diff(q(t),t)+D[2](f)(q(t),t)",
            "2*x*D[1](f)(x^2,x)+D[2](f)(x^2,x)",
            "diff(f(q(t),x),x)",
        ],
    ),
    "operators of functions that Maple knows": (
        "D(sin), D(cos), D(ln), (D@@2)(sin); D(cos)(a*t), D(tan)(0), D(sqrt)(4), D(arctan)(1), D(f);",
        ["cos, -sin, z -> 1/z, -sin", "-sin(a*t), 1, 1/4, 1/2, D(f)"],
    ),
    "a rule of a quasi-coordinate": (
        (
            "`diff/s` := proc(a,b,w) b*diff(a,w) end: P := origin(translate(s(x(t),y(t)),0,0)): "
            "comp_X(acceleration(P)); comp_X(newton_equations({make_BODY(P,1)})); "
            "`diff/z` := proc(a,b,w) c(a,b)*diff(a,w)+e(a,b)*diff(b,w) end: P := origin(translate(z(x(t),y(t)),0,0)): "
            "simplify(comp_X(velocity(acceleration(P)))-diff(z(x(t),y(t)),t,t,t));"
        ),
        [*["diff(x(t),t)*diff(y(t),t)+y(t)*diff(x(t),`$`(t,2))"] * 2, "0"],
    ),
    "a rule in a velocity": (
        "`diff/q` := proc(t) u(t) end proc: comp_X(velocity(origin(translate(q(t),0,0))));",
        ["u(t)"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_derivatives(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected


def test_rules_without_the_chain_rule_are_told() -> None:
    (message,) = failures(
        "`diff/h` := proc(a,b,c) if c = t then w(t) else 0 end if end proc: diff(h(x(t),t^2),t): "
        "velocity(origin(translate(h(x(t),t^2),0,0)));"
    )
    assert message.startswith(
        "diff/h doesn't obey the chain rule: its derivative by t is not the sum of those by its arguments"
    )


def test_rules_that_give_no_expression_are_told() -> None:
    (message,) = failures("`diff/h` := proc(a,b) [1,2] end proc: diff(h(2*t),t);")
    assert message == "diff/h gives [1, 2] for the derivative by t; expected an expression"
