"""solve, fsolve and what follows from solutions."""

import pytest

from symbody.worksheet.interpreter.interpret import Interpreter
from tests.worksheet.printed_by import failures, printed

CASES = {
    "polynomials with factors": (
        (
            "solve((2*k-m*w^2)^2-k^2,w); solve(w^6-6*w^4+10*w^2-4,w); solve(x^4+4,x); solve(x^2-(a+b)*x+a*b,x);"
            "solve((x-a)^2*(x-b),x); solve(s^2+s/m+1/m-1,s);"
        ),
        [
            "(k/m)^(1/2), -(k/m)^(1/2), 3^(1/2)*(k/m)^(1/2), -3^(1/2)*(k/m)^(1/2)",
            "2^(1/2), -2^(1/2), (2^(1/2)+2)^(1/2), -(2^(1/2)+2)^(1/2), (2-2^(1/2))^(1/2), -(2-2^(1/2))^(1/2)",
            "1+I, 1-I, -1+I, -1-I",
            "a, b",
            "b, a, a",
            "-1, (m-1)/m",
        ],
    ),
    "zeros of functions": (
        "fsolve(f->f^2-2,1..2); g := x -> cos(x)-x: fsolve(g,0..1); fsolve(sin,3..4);",
        ["1.414213562", ".7390851332", "3.141592654"],
    ),
    "as many as are wanted": ("fsolve(x^3-6*x^2+11*x-6,x,maxsols=2);", ["1., 2."]),
    "assign gives entries of tables and matrices values": (
        (
            "assign({c[1]=2, d=3}): c[1], d; assign('g[2]',7): g[2]; M := Matrix(1,2): assign('M[1,2]'=5): M; "
            "assign(solve({h[1]+h[2]=3, h[1]-h[2]=1}, {h[1],h[2]})): h[1];"
        ),
        ["2, 3", "7", "Matrix([[0, 5]])", "2"],
    ),
    "one unknown alone": (
        "solve(a*x+b=0,x); solve(z^2-4,z);",
        ["-b/a", "2, -2"],
    ),
    "roots as often as an equation has them": (
        "solve(z^2,z); solve(m*w^4-k*w^2,w); solve((q-a)^2=0,q); solve({v^2=0},{v}); solve(sqrt(z)-2,z);",
        ["0, 0", "0, 0, (k/m)^(1/2), -(k/m)^(1/2)", "a, a", "{v = 0}, {v = 0}", "4"],
    ),
    "roots of rational functions": (
        (
            "evalf(solve(z+2+5/z+1/z^2,z)); solve(.45*(V^2+1156.3)/V^2,V); solve((z^2-1)/(z-1)=0,z); "
            "solve({u+v=2,v=3+1/u+1/u^2},{u,v});"
        ),
        [
            "-.216756572, -.891621714+1.954093393*I, -.891621714-1.954093393*I",
            "34.00441148*I, -34.00441148*I",
            "-1",
            "{u = -1, v = 3}, {u = -I, v = 2+I}, {u = I, v = 2-I}",
        ],
    ),
    "functions by cases": (  # each value by hand, at both sides of its case
        (
            "solve(piecewise(q<0,-q,q^2)=4,q); solve(signum(q)*q^2=4,q); solve(max(q,1)=3,q); solve(q*abs(q)=-4,q); "
            "solve({max(u,v)=3,u-v=1},{u,v}); solve(k*abs(q)+c*signum(q)*q=F,q); solve(abs(q-1)+abs(q+1)=4,q); "
            "solve(min(q,5)=3,q); solve(signum(q)*(q-2)=0,q);"
        ),
        ["-4, 2", "2", "3", "-2", "{u = 3, v = 2}", "F/(c+k), -F/(c+k)", "2, -2", "3", "2, 0"],
    ),
    "no values that a root and an arc function don't have": (
        (
            "[solve(sqrt(q)=-3,q)]; [solve(sqrt(q^2+1)=-1,q)]; [solve({sqrt(u)=v,v=-1},{u,v})]; "
            "[solve(arctan(q)=2,q)]; solve(sqrt(q)=3,q); solve(arctan(q)=-1,q); solve(q^(-1/2)=2,q);"
        ),
        ["[]", "[]", "[]", "[]", "9", "-tan(1)", "1/4"],
    ),
    "angles by their tangent": (
        "solve(a*cos(q)=b*sin(q),q); solve(cos(2*q)=sin(2*q),q);",
        ["arctan(a/b)", "1/8*Pi"],
    ),
    "angles and logarithms that are not real": (  # as by cmath, at the sides of the cuts that Maple has
        (
            "solve(cos(q)=1.5,q); ln(-2.); arcsin(-1.5); e := arccos(c): c := -1.2: e; subs(z=2,arccos(z));"
            " solve(exp(q)+2,q);"
        ),
        [
            ".9624236501*I",
            ".6931471806+3.141592654*I",
            "-1.570796327+.9624236501*I",
            "3.141592654-.6223625037*I",
            "I*ln(3^(1/2)+2)",
            "I*Pi+ln(2)",
        ],
    ),
    "a set": (
        "solve({u+v=3,u-v=1},{u,v});",
        ["{u = 2, v = 1}"],
    ),
    "a list": (
        "solve([u+v=3,u-v=1],[u,v]); op(%); %%[1];",
        ["[[u = 2, v = 1]]", "[u = 2, v = 1]", "[u = 2, v = 1]"],
    ),
    "functions and derivatives": (
        "solve({diff(x(t),t)-3*k},{diff(x(t),t)}); solve(x(t)-2,x(t));",
        ["{diff(x(t),t) = 3*k}", "2"],
    ),
    "any name of one equation": (
        "solve(a*x=b); solve(2*u+v^2=1); solve([u+v=3]);",
        ["{a = a, b = a*x, x = x}", "{u = 1/2-1/2*v^2, v = v}", "{u = 3-v, v = v}"],
    ),
    "branches in lists and expressions": (
        "allvalues([[x=RootOf(_Z^2-3), y=1]]); allvalues(RootOf(z^2-2)+1); allvalues({u=2});",
        ["[[x = 3^(1/2), y = 1]], [[x = -3^(1/2), y = 1]]", "2^(1/2)+1, 1-2^(1/2)", "{u = 2}"],
    ),
    "a list under one derivative": (
        "solve({diff(x(t),t)-3*k, diff(y(t),t)+diff(x(t),t)}, diff([x(t),y(t)],t));",
        ["[[diff(x(t),t) = 3*k, diff(y(t),t) = -3*k]]"],
    ),
    "the first of several solutions": (
        "s := {u = v+1, w = 1}, {u = -v-1, w = 2}: u := subs(s,u); u := subs(s,u);",
        ["u := v+1", "u := v+1"],
    ),
    "roots that become complex": (
        "r := solve(m*z^2+c*z+k=0,z): subs(m=1,c=2,k=10,[r]); m := 1: c := 2: k := 10: r;",
        ["[-1+3*I, -1-3*I]", "-1+3*I, -1-3*I"],
    ),
    "expressions as unknowns": (
        (
            "solve(a*diff(x(t),t)^2=b,diff(x(t),t)^2); solve({a*cos(p(t))+b=0},{cos(p(t))}); solve(k/(x*y)=3,x*y); "
            "solve(x^2+3*x*y=4,x*y); solve(a*x^4+b*x^3=c,x^4); solve(x-3*sqrt(x)+2=0,sqrt(x)); solve(a+b+c=3,a+b); "
            "solve({x^2+y^2=1,x^2=y^2},{x^2,y^2}); solve(2*x*y*z=3,2*x*y);"
        ),
        [
            "b/a",
            "{cos(p(t)) = -b/a}",
            "1/3*k",
            "4/3-1/3*x^2",
            "(c-b*x^3)/a",
            "2, 1",
            "3-c",
            "{x^2 = 1/2, y^2 = 1/2}",
            "3/z",
        ],
    ),
    "products": (
        (
            "solve(a*sin(x)*cos(x)=0,x); solve(x^2*sin(x)=0,x); solve(exp(x)*(x-1)/(x-2)=0,x); "
            "solve(sin(x)*cos(x)=sin(x),x); [solve(k*exp(x)=0,x)];"
        ),
        ["1/2*Pi, 0", "0", "1", "0", "[]"],
    ),
    "polynomials in a function": (
        (
            "solve(2*cos(x)^2-cos(x)-1=0,x); solve(exp(2*x)-3*exp(x)+2=0,x); solve(tan(x)^2=3,x); "
            "solve(2*sin(x)^2+cos(x)-2=0,x);"
        ),
        ["0, 2/3*Pi", "0, ln(2)", "1/3*Pi, -1/3*Pi", "1/2*Pi, 1/3*Pi"],
    ),
    "a loop without sines of its angle": (
        "s := [solve({x-l*cos(p)-r*cos(q), l*sin(p)-r*sin(q)},{x,p})]: subs(s[1],x), subs(s[2],x);",
        ["r*cos(q)+l*(1-r^2*sin(q)^2/l^2)^(1/2), r*cos(q)-l*(1-r^2*sin(q)^2/l^2)^(1/2)"],
    ),
    "free unknowns": (
        "solve({x+y=1},{x,y});",
        ["{x = 1-y, y = y}"],
    ),
    "no solution": (
        "s := [solve({x=1,x=2},{x})];",
        ["s := []"],
    ),
    "allvalues": (
        "[allvalues(solve(z^2=9,z))];",
        ["[3, -3]"],
    ),
    "numbers in ranges": (
        "fsolve(cos(r)=r,r=0..1); fsolve({w^2+v^2=4,w-v=0},{w=0..3,v=0..3});",
        [".7390851332", "{v = 1.414213562, w = 1.414213562}"],
    ),
    "absolute values": (
        "solve(abs(x)=2,x); solve(abs(x-1)=-2,x); solve(abs(x)=a,x); solve({abs(x)+y=3,y-x=1},{x,y});",
        ["2, -2", "a, -a", "{x = 1, y = 2}"],
    ),
    "ranges for some of the unknowns": (
        "fsolve({x*y=2,x+y=3},{x=0..1.5,y}); fsolve([x*y=2,x+y=3],[x,y],x=0..1.5); fsolve({x*y=2,x+y=3},{x=2.2,y});",
        ["{x = 1., y = 2.}", "[x = 1., y = 2.]", "{x = 2., y = 1.}"],
    ),
    "roots that are whole numbers are decimals": (
        "fsolve(x^2-4,x); fsolve(x^3-8,x);",
        ["-2., 2.", "2."],
    ),
    "assign": (
        "assign({a=2,b=3}): a*b;",
        ["6"],
    ),
    "relations in unknowns": (
        "simplify(a*u+b*v,{u=w1,v=2*w1},[u,v]);",
        ["w1*(a+2*b)"],
    ),
    "relations of rates and accelerations": (
        (
            "X, Y, A := diff(x(t),t), diff(y(t),t), diff(a(t),t): C, S := cos(a(t)), sin(a(t)): "
            "rel := {p(t)=X*C+Y*S, r(t)=Y*C-X*S, w(t)=A}: "
            "simplify(diff(X,t)*C+diff(Y,t)*S, rel union diff(rel,t), [X, Y, A, diff(X,t), diff(Y,t), diff(A,t)]);"
        ),
        ["diff(p(t),t)-r(t)*w(t)"],
    ),
    "a relation of a polynomial": (
        "simplify(3*p^2+3*q^2,{p^2+q^2=1});",
        ["3"],
    ),
    "isolate": (
        "isolate(a*x+b=0,x);",
        ["x = -b/a"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_solving(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected


def test_solve_reports_an_expression_that_it_treats_like_a_name() -> None:
    interpreter = Interpreter()
    sheet = "solve({x*y=1, x^2=4}, {x*y, x^2}); solve(cos(x)=1, cos(x)); solve(x^2=4, x^2);"
    printed(sheet, interpreter=interpreter)
    told = "treated like a name; other terms in its variables count as known"
    assert interpreter.session.notices == [f"solve: x*y, x^2 are each {told}", f"solve: x^2 is {told}"]


def test_solutions_have_no_pivots_that_vanish() -> None:
    """Of two bodies with a joint, where all angles are zero and at rest: they fall, and the joint carries nothing."""
    sheet = """with(MBSymba_r6): FzJ(t) := 0: _gravity := make_VECTOR(ground,0,-g,0):
    for i to 2 do B||i := make_BODY(translate(x||i(t),y||i(t),0)*rotate('Z',p||i(t)), m||i, 0,0,J||i) od:
    phi, RA, RR := spherical_JOINT(make_POINT(B1[frame],a1,0,0), make_POINT(B2[frame],-b2,0,0), B1, B2, "J"):
    eqs := {comp_XYZ(newton_equations({B1,RA})), comp_XYZ(newton_equations({B2,RR})), comp_Z(euler_equations({B1,RA})),
    comp_Z(euler_equations({B2,RR})), diff(comp_X(phi,ground),t,t), diff(comp_Y(phi,ground),t,t)} minus {0}:
    S := solve(eqs, {seq(op(diff([x||i(t),y||i(t),p||i(t)],t,t)),i=1..2), FxJ(t), FyJ(t)}):
    simplify(subs(S, p1(t)=0, p2(t)=0, diff(p1(t),t)=0, diff(p2(t),t)=0, [FxJ(t),FyJ(t)]));"""
    assert printed(sheet)[-1] == "[0, 0]"


def test_fsolve_names_values_of_functions_that_have_no_number() -> None:
    (message,) = failures("fsolve({cos(p)+phi(0)=1, s=2}, {p=0..2, s=1..3});")
    assert "fsolve: phi(0) is in the equations, and not solved for" in message


def test_roots_of_several_names_need_their_unknown() -> None:
    assert failures("RootOf(x^2 - a);") == ["RootOf: x^2-a; expected its unknown, as in RootOf(x^2 - a, x)"]


def test_an_equation_that_holds_all_over_a_case_is_refused() -> None:
    assert failures("solve(signum(q)=1,q);") == [
        "solve: signum(q) = 1 solves an equation wherever it holds; expected equations with single solutions"
    ]
