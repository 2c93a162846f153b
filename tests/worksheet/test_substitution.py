"""subs replaces parts of the printed structure, and nothing else."""

import pytest

from tests.worksheet.printed_by import printed

CASES = {
    "operators for functions": (
        "e := diff(x(t),t)+x(t)+f(2): eval(e, [x=(t->sin(t)), f=(z->z^2)]), eval(x(3), x=(u->u^2));",
        ["cos(t)+sin(t)+4, 9"],
    ),
    "indices and heads of indexed names": (
        (
            "subs(i=2, a[i]+diff(q[i](t),t)), subs(a=b, a[1]+c[1]), subs(a=3, a[1]), "
            "subs(a[1]=a[2], a[2]=a[1], a[1]*a[3]);"
        ),
        ["a[2]+diff(q[2](t),t), b[1]+c[1], a[1], a[1]*a[3]"],
    ),
    "one after the other": (
        "subs(u=2,v=u,u+v);",
        ["u+2"],
    ),
    "at once": (
        "subs([u=v,v=u],u+2*v), subs({u=v,v=u},u+2*v);",
        ["2*u+v, 2*u+v"],
    ),
    "a derivative before the function": (
        "subs(diff(x(t),t)=u, x(t)=0, diff(x(t),t)+x(t)*k);",
        ["u"],
    ),
    "the same in a set": (
        "subs({x(t)=0, diff(x(t),t)=u}, diff(x(t),t)+x(t)*k);",
        ["u"],
    ),
    "a function in its derivative": (
        "subs(x(t)=A*sin(t), diff(x(t),t,t));",
        ["-A*sin(t)"],
    ),
    "a function of a variable in its derivative": (
        (
            "subs(y(x)=x^2, diff(y(x),x)+y(x)); eval(diff(y(x),x,x), diff(y(x),x)=w(x)); "
            "subs(f(u,v)=u*v^2, diff(f(u,v),u,v));"
        ),
        ["x^2+2*x", "diff(w(x),x)", "2*v"],
    ),
    "a power in a product": (
        "subs(d(t)^2=0, a*d(t)^2+d(t));",
        ["d(t)"],
    ),
    "another power stays": (
        "subs(x^2=0, x^3+x^2*k);",
        ["x^3"],
    ),
    "a rate that the printed form has cancelled": (
        (
            "w := simplify(solve(a*diff(q(t),t)*cos(q(t)) = b*diff(p(t),t), diff(p(t),t))): i := w/diff(q(t),t): "
            "subs(q(t) = 0, i); eval(i, q(t) = Pi/3); 1/diff(q(t),t): subs(q(t) = 1, w/diff(q(t),t)^2*diff(q(t),t));"
        ),
        ["a/b", "1/2*a/b", "a*cos(1)/b"],
    ),
    "a sum inside a longer one stays": (
        "subs(a+b=c,a+b+d);",
        ["a+b+d"],
    ),
    "a product inside a longer one stays": (
        "subs(a*b=c,a*b*d);",
        ["a*b*d"],
    ),
    "a function of an angle": (
        "subs(cos(q(t))=c, m*cos(q(t))+cos(2*q(t)));",
        ["c*m+cos(2*q(t))"],
    ),
    "lists and equations": (
        "subs(a=1,[a,b=a]);",
        ["[1, b = 1]"],
    ),
    "a matrix": (
        "M := Matrix([[a,1],[0,a]]): subs(a=2,M);",
        ["Matrix([[2, 1], [0, 2]])"],
    ),
    "a vector": (
        "v := make_VECTOR(ground,a,b,0): comp_X(subs(a=5,v));",
        ["5"],
    ),
    "a body": (
        "B := make_BODY(ground,m): C := subs(m=3,B): C[mass];",
        ["3"],
    ),
    "the time": (
        "subs(t=0,x(t)+diff(x(t),t));",
        ["D(x)(0)+x(0)"],
    ),
    "a name of a function": (
        "subs(f=g,f(2)+f(t));",
        ["g(2)+g(t)"],
    ),
    "a solution": (
        "s := solve({u+v=3,u-v=1},{u,v}): subs(s,u*v);",
        ["2"],
    ),
    "eval at a point": (
        "eval(x^2+y,x=3); eval(x+y,[x=1,y=2]);",
        ["y+9", "3"],
    ),
    "algsubs divides": (
        "algsubs(a*b=c,a*b*d+a*b);",
        ["c*d+c"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_substitution(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected
