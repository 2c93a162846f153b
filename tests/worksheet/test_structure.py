"""Maple's op, nops, has and indets see the printed structure."""

import pytest

from tests.worksheet.printed_by import failures, printed

CASES = {
    "entries that are assigned": (
        (
            "s[a] := 1: k := a: assigned(s[k]), assigned(s[b]), evaln(s[k]); L := [1,2]: assigned(L[1]);"
            "c := proc(L) local n, k; for k in L do if not assigned(n[k]) then n[k] := 0 fi; n[k] := n[k]+1 od;"
            "n[u], n[v] end: c([u,v,u]);"
        ),
        ["true, false, s[a]", "true", "2, 1"],
    ),
    "tables within tables": (
        "R[1][2][b] := 3: eval(R); indices(R), assigned(R[1]);",
        ["table([1 = table([2 = table([b = 3])])])", "[1], true"],
    ),
    "operands": (
        "op(a+b*c); op(2,u=v); op([1,2],[[1,2],3]); op(0,f(x)); op(1..2,[a,b,c]);",
        ["b*c, a", "v", "2", "f", "a, b"],
    ),
    "operands of indexed names": (
        "op(0,a[i]), op(a[i]), op(a[1,2]), nops(a[1,2]), op(0,q[1](t)), map(op, [b[1],b[2]]);",
        ["a, i, 1, 2, 2, q[1], [1, 2]"],
    ),
    "tables that are zero elsewhere": (
        "T := table(sparse): T[1] := a: T[1], T[5]; add(T[i],i=1..3); e := T[7]+b: U := copy(T): U[3]; eval(T);",
        ["a, 0", "a", "0", "table(sparse, [1 = a])"],
    ),
    "counts": (
        "nops(a+b+c), nops(a*b), nops([a,b]), nops({a,a}), nops(x), nops(u=v);",
        ["3, 2, 2, 1, 1, 2"],
    ),
    "elements": (
        "T := table([a=1,b=2]): numelems(T), numelems([1,2,3]), numelems(<1,2>), nops(T);",
        ["2, 3, 2, 1"],
    ),
    "names by macro": (
        "macro(C1=cos(theta), R=rotate): C1^2; R('Z',q(t))[1,1];",
        ["cos(theta)^2", "cos(q(t))"],
    ),
    "has a function": (
        "has([sin(q(t)),3],q(t)), has(diff(q(t),t),q(t)), has(q(t),p(t));",
        ["true, true, false"],
    ),
    "has a power in a product": (
        "has(a*d(t)^2,d(t)^2), has(a*d(t)^3,d(t)^2), has(cos(d(t))*a,cos(d(t)));",
        ["true, false, true"],
    ),
    "has one of several": (
        "has(a*b,[c,b]), has(a*b,{c});",
        ["true, false"],
    ),
    "has in a matrix": (
        "has(Matrix([[a,1],[0,b]]),b);",
        ["true"],
    ),
    "has a derivative": (
        "has(Matrix([[diff(x(t),t)]]),diff(x(t),t)), has(x(t),diff(x(t),t));",
        ["true, false"],
    ),
    "coefficients by value": (
        "e := a*x^2+b*x+c: coeff(e,x,2), coeff(e,x^2), coeff(e,x), coeff(e,x,0);",
        ["a, a, b, c"],
    ),
    "coefficients of a function": (
        "coeff(m*diff(x(t),t,t)+k*x(t),diff(x(t),t,t));",
        ["m"],
    ),
    "collect": (
        "collect(a*x+b*x+c,x); collect((x+1)*(x+a),x,simplify);",
        ["x*(a+b)+c", "x^2+x*(a+1)+a"],
    ),
    "negative powers": (
        (
            "coeff(a/x^2+b,x,-2), coeff(expand((x+1)^2/x),x,-1), ldegree(x+1/x,x), degree(1/x,x);"
            " collect(a*V+b/V+c*V+d/V,V,simplify);"
        ),
        ["a, 1, -1, -1", "V*(a+c)+(b+d)/V"],
    ),
    "parts of a structured type": (
        (
            "e := X*cos(d) + m*diff(x(t),t,t): indets(e,'specfunc(anything,diff)'); indets(e,specfunc(cos));"
            " indets(e,And(name,Not(identical(m,t)))); subs(map(d->d=0,[op(indets(e,specfunc(diff)))]),e);"
            " hastype(e,float); subsindets(2.5*x(t)+y,float,convert,rational);"
        ),
        ["{diff(x(t),`$`(t,2)), diff(x(t),t)}", "{cos(d)}", "{X, d}", "X*cos(d)", "false", "5/2*x(t)+y"],
    ),
    "structured types": (
        (
            "type(a=3,name=numeric), type(a=b,name=numeric), type([a=1],'list(name=numeric)'),"
            " type(sin(x),polynom(anything,x)), type(x^2,'name^integer'), type(3,satisfies(x->x>2)),"
            " type(f(x),'anyfunc'(name)), type(Matrix(2,3),'Matrix'(square)), type(x^2,quadratic(x));"
            " `type/odd2` := e -> type(e,odd): type(3,odd2), type(2,odd2);"
        ),
        ["true, false, true, false, true, true, true, false, true", "true, false"],
    ),
    "an entry that gets its own name has none": (
        "T := table([a=1,b=2]): T[a] := 'T[a]': eval(T), assigned(T[a]); indices(T,pairs); cat(q,1..2);",
        ["table([b = 2]), false", "b = 2", "q1, q2"],
    ),
    "basic types": (
        "whattype(f(x)), whattype(a[1]), whattype(a<b), whattype(Matrix(2)), whattype(<1,2>);",
        ["function, indexed, `<`, Matrix, Vector[column]"],
    ),
    "indets": (
        "indets(x^2+sin(y(t)),'function'); indets(a+b*c);",
        ["{sin(y(t)), y(t)}", "{a, b, c}"],
    ),
    "map": (
        "map(sin,[0,Pi/2]); map(f,a+b); map(diff,[x^2,x],x); map2(f,a,[1,2]);",
        ["[0, 1]", "f(a)+f(b)", "[2*x, 1]", "[f(a,1), f(a,2)]"],
    ),
    "elementwise": (
        "rhs~([a=b,c=d]); diff(x(t),t)=~0; [1,2] +~ 3; f~([a,b]);",
        ["[b, d]", "diff(x(t),t) = 0", "[4, 5]", "[f(a), f(b)]"],
    ),
    "select and remove": (
        "select(has,[a*x,b],x); remove(has,a*x+b,x); select(x->x>1,[1,2,3]);",
        ["[a*x]", "b", "[2, 3]"],
    ),
    "select of a call": (
        "select(has,f(a,x),x), remove(has,f(a,x),x), select(has,sin(x),x);",
        ["f(x), f(a), sin(x)"],
    ),
    "subsop": (
        "subsop(2=z,[a,b,c]);",
        ["[a, z, c]"],
    ),
    "subsop by place, not by value": (
        "subsop(1=z,f(a,a)); subsop(2=3,x^x); subsop(1=NULL,f(a,b)); subsop(1=5,a[1,2]);",
        ["f(z,a)", "x^3", "f(b)", "a[5,2]"],
    ),
    "subsop of a function, and within": (
        "subsop(0=g,f(x)); subsop(0=cos,sin(x)); subsop([1,1]=z,[[a,b]]); subsop([2,1]=z,[c,sin(b)]);",
        ["g(x)", "cos(x)", "[[z, b]]", "[c, sin(z)]"],
    ),
    "applyop at several places": (
        "applyop(f,{1,2},a+b); applyop(f,[1,1],[[a]]);",
        ["f(a)+f(b)", "[[f(a)]]"],
    ),
    "kinds of what op(0, ..) tells": (
        "op(0,1.5), op(0,<1,2>), op(0,Matrix(2)), op(0,matrix(2,2));",
        ["Float, Vector[column], Matrix, array"],
    ),
    "what a rational expression is made of": (
        "indets(a+I); indets(sqrt(x)+x^y+sqrt(2)+sin(1)); indets(Pi*x), indets(Pi*x,name);",
        ["{a}", "{x, y, x^(1/2), x^y}", "{x}, {Pi, x}"],
    ),
    "parts of a type in containers and calls": (
        "indets([a=b,c],`=`); indets([[a],{c}],list); indets(Int(f(x),x)+y,name);",
        ["{a = b}", "{[[a], {c}], [a]}", "{x, y}"],
    ),
    "types of numbers and names": (
        "type(3.,posint), type(4.,even), type(Pi,name), type(I,name), type(x::y,`::`);",
        ["false, false, true, false, true"],
    ),
    "operators as functions that make containers": (
        "zip(`[]`,[1,2],[a,b]); `{}`(1,1), `..`(1,2);",
        ["[[1, a], [2, b]]", "{1}, 1 .. 2"],
    ),
    "the powers of coefficients": (
        "coeffs(a*x*y+b*y+c,[x,y],'p'); [p]; degree(x*y^2+x,{x,y}); coeff(taylor(exp(x),x),x,3);",
        ["c, b, a", "[1, y, x*y]", "3", "1/6"],
    ),
    "convert": (
        "convert([1,2,1],set); convert({b,a},list); convert(a+b,string); T[2]:=b: T[1]:=a: convert(T,list);",
        ["{1, 2}", "[a, b]", '"a+b"', "[a, b]"],
    ),
    "has of the names of functions": (
        (
            "has(a*diff(x(t),t),diff), has(sin(q),sin), has(psi[dot](t),psi), has(a[1]+b,a), has(D(f)(0),f);"
            "has(x(t),diff), has({y=g(h(x))},h), has(Int(x,x),Int), has(a[1],b); select(has,[x(t),diff(x(t),t)],diff);"
        ),
        ["true, true, true, true, true", "false, true, true, false", "[diff(x(t),t)]"],
    ),
    "sets merge what is equal in value": (
        "nops({sin(x)^2+cos(x)^2, 1});",
        ["1"],
    ),
    "convert to an equation": (
        "convert(x<3,equality), convert(x,equality);",
        ["x = 3, x = 0"],
    ),
    "sides": (
        "lhs(a=b), rhs(a=b), lhs(1..n);",
        ["a, b, 1"],
    ),
    "length": (
        'length("abc"), length(1234);',
        ["3, 4"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_structure(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected


def test_an_operand_gets_a_function() -> None:
    assert printed("applyop(sin, 2, [a, b]); applyop(f, 1, x + y, z);") == ["[a, sin(b)]", "f(x,z)+y"]


def test_parts_of_strings_are_ranges() -> None:
    assert printed('"abcdef"[2..4], "abc"[2..], "abc"[-1];') == ['"bcd", "bc", "c"']


def test_a_type_that_nobody_knows() -> None:
    (message,) = failures("type(3, fooo);")
    assert message == (
        "type: fooo is not a type that is known here; expected one of Maple's, such as name, or one of the "
        "sheet's own, `type/fooo` := e -> .."
    )
