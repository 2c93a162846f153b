"""A call that isn't worked out stands in a scalar by its text; commands see what it holds."""

from __future__ import annotations

import pytest

from tests.worksheet.printed_by import failures, printed

CASES = {
    "derivative by the chain rule": (
        "diff(2*int(f(s),s=0..x(t)),t); diff(3*floor(z)+z,z); diff(1/2*Sum(a[k]*q[k](t)^2,k=1..n),t);",
        [
            "2*diff(int(f(s),s = 0 .. x(t)),t)",
            "3*diff(floor(z),z)+1",
            "1/2*diff(Sum(a[k]*q[k](t)^2,k = 1 .. n),t)",
        ],
    ),
    "what it doesn't hold": ("diff(2*int(f(s),s=0..x(t)),y);", ["0"]),
    "substitution": (
        "subs(x(t)=1,2*Int(sin(s),s=0..x(t))); subs(z=2.5,3*floor(z)+z); eval(3*floor(z)+z,z=2.5);",
        ["2*Int(sin(s),s = 0 .. 1)", "8.5", "8.5"],
    ),
    "a value given later": ("a := 3*floor(w)+w: w := 2.5: a;", ["8.5"]),
    "a call, and a derivative, of which an operator is made": (
        "f(a,b)(c); sin(x)(3); diff(x(t),t)(0); 2*x(t)(0); (f+sin(x))(3); (f/2-3*g^2)(u); subs(a=1,f(a)(b));",
        [
            "f(a,b)(c)",
            "sin(x)(3)",
            "diff(x(t),t)(0)",
            "2*x(t)(0)",
            "f(3)+sin(x)(3)",
            "1/2*f(u)-3*g(u)^2",
            "f(1)(b)",
        ],
    ),
    "an operator": ("f := unapply(3*floor(z)+z,z); f(2.5);", ["f := z -> 3*floor(z)+z", "8.5"]),
    "occurrence": ("has(2*Int(sin(s),s=0..x(t)),x(t)), has(2*Int(sin(s),s=0..x(t)),y);", ["true, false"]),
    "integrals with indexed names": (
        "int(a[1]*x,x=0..1); int(x^2*q[1](t),x=0..L); int(m[1],x); int(t*b[1],t); int(a[x],x);",
        ["1/2*a[1]", "1/3*L^3*q[1](t)", "m[1]*x", "1/2*b[1]*t^2", "int(a[x],x)"],
    ),
    "a beam by one mode": (
        "T := int(mu/2*(x*diff(q[1](t),t))^2,x=0..L): lagrange(2*T,q[1](t),t);",
        ["2/3*L^3*mu*diff(q[1](t),`$`(t,2))"],
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_unknown_calls(name: str) -> None:
    text, lines = CASES[name]
    assert printed(text) == lines


def test_an_energy_that_is_not_known_is_refused() -> None:
    assert failures("lagrange(2*int(f(s),s=0..x(t)),x(t),t);") == [
        (
            "lagrange: int(f(s),s = 0 .. x(t)) depends on the motion and isn't worked out; expected an energy whose "
            "derivatives are known"
        )
    ]
