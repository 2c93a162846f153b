"""One-dimensional notation."""

import pytest

from tests.worksheet.printed_by import printed

CASES = {
    "sums and products": (
        "2*(u+v)-3*u; x/y/z; (x+y)^2/(2*z); -(a+b)*c;",
        ["2*v-u", "x/y/z", "1/2*(x+y)^2/z", "-c*(a+b)"],
    ),
    "roots": (
        "sqrt(3)*l/2; 1/sqrt(x^2+y^2); sqrt(8);",
        ["1/2*3^(1/2)*l", "1/(x^2+y^2)^(1/2)", "2*2^(1/2)"],
    ),
    "decimals": (
        ".5; 9.81; 1.0; 0.017; 1e-12*k; 100.0; 0.1+0.2;",
        [".5", "9.81", "1.", ".17e-1", ".1e-11*k", "100.", ".3"],
    ),
    "evalf": (
        "evalf(Pi); evalf(1/3); evalf(sqrt(2)*a); evalf(x^2/3);",
        ["3.141592654", ".3333333333", "1.414213562*a", ".3333333333*x^2"],
    ),
    "integers of many digits": (
        "length(2^20000); 2^20000 - 2^20000 + 1; 10^4400 - 10^4400/2; 10^12000; 1/10^12000;",
        [
            "6021",
            "1",
            "5" + "0" * 4399,
            f"1{'0' * 99}[...11801 digits...]{'0' * 100}",
            f"1/1{'0' * 99}[...11801 digits...]{'0' * 100}",
        ],
    ),
    "integers of many digits as text": (
        'printf("%d", 10^5000 + 7); evalf(10^5000) - 10^5000; ' + "9" * 5000 + "+1;",
        ["1" + "0" * 4999 + "7", "0", "1" + "0" * 5000],
    ),
    "digits": (
        "Digits := 4: evalf(Pi);",
        ["3.142"],
    ),
    "places": (
        "interface(displayprecision=2): evalf(Pi);",
        ["3.14"],
    ),
    "derivatives": (
        "diff(x(t),t); diff(x(t),t,t);",
        ["diff(x(t),t)", "diff(x(t),`$`(t,2))"],
    ),
    "primes": (
        "PDEtools[declare](prime=t,quiet): diff(x(t),t)+diff(mu(t),t)^2; diff(x(t),t,t);",
        ["(mu^`'`)^2+`x'`", "`x''`"],
    ),
    "declared functions": (
        "PDEtools[declare](x(t)): x(t)^2;",
        ["x(t) will now be displayed as x", "x^2"],
    ),
    "a misspelt option is not quiet": (
        "PDEtools[declare]({x(t),y(t)},qiet): x(t);",
        ["x(t) will now be displayed as x", "y(t) will now be displayed as y", "x"],
    ),
    "an alias": (
        "alias(c=cos): cos(x); c(0);",
        ["c(x)", "1"],
    ),
    "names that need quotes": (
        "`a b`; `x'`;",
        ["`a b`", "`x'`"],
    ),
    "strings, sets, ranges": (
        '"a\\\\b"; {b,a}; 1..n; a<>b; a>b;',
        ['"a\\\\b"', "{a, b}", "1 .. n", "a <> b", "b < a"],
    ),
    "functions": (
        "arctan(y,x); exp(2*x); ln(x); abs(x); signum(x); sec(x);",
        ["arctan(y,x)", "exp(2*x)", "ln(x)", "abs(x)", "signum(x)", "sec(x)"],
    ),
    "a table": (
        "table([a=1,b=2]); T := table([1=x]): print(T);",
        ["table([a = 1, b = 2])", "table([1 = x])"],
    ),
    "a procedure": (
        "f := proc(x) local y; y := x; y end proc;",
        ["f := proc (x) local y; y := x; y end proc"],
    ),
    "an indexed function": (
        "psi[dot](t); phi[P](t)^2; a[i]*2;",
        ["psi[dot](t)", "phi[P](t)^2", "2*a[i]"],
    ),
    "printf": (
        (
            'printf("%+06.3f|%d|%s|%a\\n",1.5,3,"x",a+b): printf("a"): printf("%5.2f%%\\n",2.5); '
            'printf("%*.*f\\n", 6, 1, 2.5); printf("%a %a %A %s", "u", `a b`, "v", "w");'
        ),
        ["+1.500|3|x|a+b", "a", " 2.50%", "   2.5", '"u" `a b` v w'],
    ),
    "texts": (
        'with(StringTools): Reverse("abc"), Explode("ab"), IsDigit("12"), IsDigit("1a");',
        ['"cba", ["a", "b"], true, false'],
    ),
    "printf of vectors and matrices": (
        'V := Vector([1.5,2,-3]): printf("[%{c,}.2f] %+.1f", V, V); printf("%{c;}d", Matrix([[1,2],[3,4]]));',
        ["[1.50,2.00,-3.00] +1.5 +2.0 -3.0", "1;2\n3;4"],
    ),
}


@pytest.mark.parametrize(("sheet", "expected"), CASES.values(), ids=CASES.keys())
def test_printing(sheet: str, expected: list[str]) -> None:
    assert printed(sheet) == expected
