"""Equalities that users expect, whether `==` knows them, and why not; and pairs that only look equal.

`test_expected_equalities.py` checks each row, and that `docs/values.md` holds the tables. After a change of the rows

    python -m tests.symbolic.expected_equalities

writes them there. Texts are read by `reading.py`: x, y, z are real, a, b, c positive, and s is complex.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

DOCUMENT = Path(__file__).parents[2] / "docs/values.md"
BEGIN, END = "<!-- table of equalities: begin -->", "<!-- table of equalities: end -->"


@dataclass(frozen=True)
class Equality:
    """Two texts of the same value."""

    left: str
    right: str
    is_known: bool
    reason: str


def known(reason: str, *pairs: tuple[str, str]) -> tuple[Equality, ...]:
    return tuple(Equality(left, right, is_known=True, reason=reason) for left, right in pairs)


def missed(reason: str, *pairs: tuple[str, str]) -> tuple[Equality, ...]:
    return tuple(Equality(left, right, is_known=False, reason=reason) for left, right in pairs)


EQUALITIES: tuple[Equality, ...] = (
    *known(
        "a root depends on the value of its argument alone",
        ("4*(x**2 + 1)", "4*x**2 + 4"),
        ("sqrt(4*(x**2 + 1))", "sqrt(4*x**2 + 4)"),
        ("sqrt(4*(x**2 + 1))", "2*sqrt(x**2 + 1)"),
        ("sqrt((2*x)**2 + (2*y)**2)", "2*sqrt(x**2 + y**2)"),
        ("sqrt((a*x)**2 + (a*y)**2)", "a*sqrt(x**2 + y**2)"),
        ("sqrt((x/a)**2 + (y/a)**2)", "sqrt(x**2 + y**2)/a"),
        ("sqrt(67*x**2 + 67*y**2)", "sqrt(67)*sqrt(x**2 + y**2)"),
        ("sqrt(x**2)", "abs(x)"),
        ("sqrt(x**2 + 2*x*y + y**2)", "abs(x + y)"),
        ("sqrt(a*cos(x)**2 + a*sin(x)**2)", "sqrt(a)"),
        ("sqrt(-a*(a + (-1 - x)))", "sqrt(a*x + a - a**2)"),
        ("sqrt(a**2*b)", "a*sqrt(b)"),
        ("sqrt(a)*sqrt(b)", "sqrt(a*b)"),
    ),
    *known(
        "a root squares to its argument",
        ("sqrt(x**2 + y**2 + 1)**2", "x**2 + y**2 + 1"),
        (
            "x**2/sqrt(x**2 + y**2 + 1) + y**2/sqrt(x**2 + y**2 + 1) + 1/sqrt(x**2 + y**2 + 1)",
            "sqrt(x**2 + y**2 + 1)",
        ),
        (
            "(x**2/sqrt(x**2 + y**2 + 1) + y**2/sqrt(x**2 + y**2 + 1) + 1/sqrt(x**2 + y**2 + 1))**2",
            "x**2 + y**2 + 1",
        ),
        ("(x - y)/sqrt(x)", "sqrt(x) - y/sqrt(x)"),
        ("1/((x - y)/sqrt(x))", "1/(sqrt(x) - y/sqrt(x))"),
        ("((x - y)/sqrt(x))**2", "(sqrt(x) - y/sqrt(x))**2"),
        ("(sqrt(x) + 1)*(sqrt(x) - 1)", "x - 1"),
        ("1/(sqrt(x + 1) - sqrt(x))", "sqrt(x + 1) + sqrt(x)"),
        ("sqrt(sqrt(a))**4", "a"),
        ("sqrt(sqrt(x**2 + 1) + 2)**2", "sqrt(x**2 + 1) + 2"),
        ("((x + sqrt(y))**(1/3))**3", "x + sqrt(y)"),
        ("abs(109*z + x**2/sqrt(x**2 + y**2) + y**2/sqrt(x**2 + y**2) - sqrt(x**2 + y**2))", "109*abs(z)"),
    ),
    *known(
        "the square root of a negative value has an exact angle, so its odd roots are principal",
        ("sqrt(x)**(1/3)", "x**(1/6)"),
        ("(sqrt(x)**(2/3)*y + sqrt(x)**(2/3)*z)**3", "x*(y + z)**3"),
        ("(sqrt(x**2 + y**2)**(2/3)*z + sqrt(x**2 + y**2)**(2/3))**3", "(x**2 + y**2)*(z + 1)**3"),
    ),
    *known(
        "the power n of a root of degree n is the radicand in every lane, also of what is negative or not real",
        ("((sqrt(x) + 1)**(1/3)*y + (sqrt(x) + 1)**(1/3)*z)**3", "(sqrt(x) + 1)*(y + z)**3"),
        ("(x**(1/13)*y + x**(1/13)*z)**13", "x*(y + z)**13"),
        ("(x**(67/109)*y + x**(67/109)*z)*x", "x**(176/109)*(y + z)"),
        ("sqrt(x**(1/13) + 1)**2", "x**(1/13) + 1"),
        ("(z*sqrt(x**(1/13) + 1))*(z*sqrt(x**(1/13) + 1))", "z**2*(x**(1/13) + 1)"),
        ("sqrt(cosh(log(y)/13))*sqrt(y**(1/13) + y**(-1/13))", "sqrt(2)*cosh(log(y)/13)"),
        ("sqrt(tanh(log(x)/13))*sqrt(tanh(log(x)/13))", "tanh(log(x)/13)"),
        ("x**(-9/100)*(x**(1/100)*y + x**(1/100)*z)**9", "(y + z)**9"),
    ),
    *known(
        "sines of one angle and of its half hold the same roots, which count once among the signs",
        (
            "sqrt(sin(atan2(b, y)))*sqrt(2*sin(atan2(b, y)/2)*cos(atan2(-b, y)/2))",
            "sin(atan2(b, y))",
        ),
    ),
    *known(
        "the modulus and the sign are multiplicative",
        ("abs(a*x)", "a*abs(x)"),
        ("abs(67*x)", "67*abs(x)"),
        ("abs((sin(y) + 5)**2 - (sin(y) - 5)**2 + 27*sin(y))", "47*abs(sin(y))"),
        ("abs(-x)", "abs(x)"),
        ("abs(x*y)", "abs(x)*abs(y)"),
        ("abs(a*cos(x)**2 + a*sin(x)**2)", "a"),
        ("abs(x**2 + 2*x + 1)", "(x + 1)**2"),
        ("sign(x)**2", "1"),
        ("sign(x)**3", "sign(x)"),
        ("sign(x*y)", "sign(x)*sign(y)"),
        ("sign(a*x)", "sign(x)"),
        ("sign(1/x)", "sign(x)"),
        ("abs(x)/x", "sign(x)"),
        ("(x + abs(x))/(abs(x)*(1 + sign(x)))", "1"),
        ("Max(3*x, 0)/(-3*Max(x, 0))", "-1"),
        ("(abs(x) - 1)*(abs(x) + 1)", "x**2 - 1"),
    ),
    *known("exponentials are positive", ("sign(exp(x))", "1")),
    *known(
        "a sign in an argument is the same sign as outside of it",
        ("sin(abs(x))", "sign(x)*sin(x)"),
        ("sin(abs(x + 2*y))*sign(x + 2*y)", "sin(x + 2*y)"),
        ("exp(abs(x))", "cosh(x) + sign(x)*sinh(x)"),
        ("a**sign(x)", "Piecewise((a, x), otherwise=1/a)"),
    ),
    *known(
        "where signs are those of a lane, an exponent is a number and an angle is a multiple of pi",
        ("2**sign(x)", "Piecewise((2, x), otherwise=1/2)"),
        ("67**(sign(x)/2)", "Piecewise((sqrt(67), x), otherwise=1/sqrt(67))"),
        ("2**Piecewise((2, x), otherwise=3)", "Piecewise((4, x), otherwise=8)"),
        ("2**abs(x)", "Piecewise((2**x, x), otherwise=2**(-x))"),
        ("x**sign(y)", "Piecewise((x, y), otherwise=1/x)"),
        ("exp(sign(y)*log(x**2))", "(x**2)**sign(y)"),
        ("cos(pi*sign(x)/3)", "1/2"),
        ("sin(pi*Piecewise((1, x), otherwise=1/2)/3)", "Piecewise((sqrt(3)/2, x), otherwise=1/2)"),
        ("tan(sign(x)*atan(y))", "sign(x)*y"),
        ("tan(sign(14*x - 7)*atan(y))", "sign(2*x - 1)*y"),
    ),
    *missed(
        "the root of a square that its form does not show has a sign of its own in each field of arguments",
        ("cos(a*sqrt((b + 1)**2*x)/((b + 1)*sqrt(x)))", "cos(a)"),
        ("cosh(sqrt((b + 1)*x)/sqrt(b + 1))", "cosh(sqrt(x))"),
    ),
    *known(
        "the signs of both arguments are known",
        ("atan2(2*b, 2*b)", "pi/4"),
        ("atan2(exp(x), -exp(x))", "3*pi/4"),
        ("atan2(0, x**2)", "0"),
    ),
    *missed(
        "the logarithm of a negative base is drawn for the base, not for its modulus",
        ("abs(x**y)", "abs(x)**y"),
        ("log(x**2)", "2*log(abs(x))"),
        ("log(1/x**2)", "-log(x**2)"),
        ("(x**4)**y", "(x**2)**(2*y)"),
    ),
    *missed(
        "sqrt(x**2 + y**2) is positive by itself; its square and its reciprocal, which is it over its square, are not",
        ("abs(z/sqrt(x**2 + y**2))", "abs(z)/sqrt(x**2 + y**2)"),
        ("abs((x**2 + y**2)**(3/2))", "(x**2 + y**2)**(3/2)"),
        ("sqrt(1/(x**2 + y**2))", "1/sqrt(x**2 + y**2)"),
        ("atan2(y*sqrt(x**2 + y**2), x*sqrt(x**2 + y**2))", "atan2(y, x)"),
        ("log(x**2 + y**2)", "2*log(sqrt(x**2 + y**2))"),
        ("log(a*sqrt(x**2 + y**2))", "log(a) + log(sqrt(x**2 + y**2))"),
    ),
    *missed(
        "a sum of squares or of positive terms need not be a square in a finite field",
        ("abs(x**2 + 1)", "x**2 + 1"),
        ("sign(x**2 + y**2 + 1)", "1"),
        ("abs(a + b)", "a + b"),
        ("sqrt((a + 1)**2*x)", "(a + 1)*sqrt(x)"),
        ("Max(a, -b)", "a"),
    ),
    *missed(
        "that a difference is positive takes more than the signs of its terms",
        ("abs(x**2 - x + 1)", "x**2 - x + 1"),
        ("abs(2 - sin(x))", "2 - sin(x)"),
        ("Max(x**2 + 1, 2*x - 1)", "x**2 + 1"),
    ),
    *known(
        "the maximum and the minimum are half the sum and the distance",
        ("Max(x, y)*Min(x, y)", "x*y"),
        ("Max(x, y) + Min(x, y)", "x + y"),
        ("Max(2*x, 2*y)", "2*Max(x, y)"),
        ("Max(a*x, a*y)", "a*Max(x, y)"),
        ("Max(67*x, 67*y)", "67*Max(x, y)"),
        ("Max((67*abs(x))**(1/13), z)", "Max(67**(1/13)*abs(x)**(1/13), z)"),
        ("Max(67*x + z, 67*y + z)", "67*Max(x, y) + z"),
        ("-Max(x, y)", "Min(-x, -y)"),
        ("Max(x, -x)", "abs(x)"),
        ("Max(x + z, y + z)", "Max(x, y) + z"),
        ("Max(x, Min(x, y))", "x"),
    ),
    *missed(
        "the signs of x - y, y - z and x - z are independent in a finite field, which has no order",
        ("Max(Max(x, y), z)", "Max(x, Max(y, z))"),
        ("Max(Max(2*x, 2*y), 2*z)", "2*Max(x, y, z)"),
    ),
    *known(
        "powers of numbers have one form",
        ("sqrt(2**(3/2))", "2**(3/4)"),
        ("2**(1/3)*4**(1/3)", "2"),
        ("2**(1/3)*2**(2/3)", "2"),
        ("6**(1/3)", "2**(1/3)*3**(1/3)"),
        ("(8/27)**(1/3)", "2/3"),
        ("sqrt(8)", "2*sqrt(2)"),
        ("sqrt(67)**2", "67"),
        ("sqrt(67)*sqrt(109)", "sqrt(7303)"),
        ("7303**(1/3)", "67**(1/3)*109**(1/3)"),
        ("4**x", "2**(2*x)"),
        ("2**x", "exp(x*log(2)/3)**3"),
        ("a**x", "exp(x*log(a)/3)**3"),
        ("6**x", "2**x*3**x"),
        ("(1/2)**x", "2**(-x)"),
        ("8**(x/3)", "2**x"),
    ),
    *known(
        "odd roots of positive values are unique in the field",
        ("(8*a)**(1/3)", "2*a**(1/3)"),
        ("(a**3)**(1/3)", "a"),
        ("((a**2*b)**(1/3))**3", "a**2*b"),
        ("(8*x**2 + 8)**(1/3)", "2*(x**2 + 1)**(1/3)"),
        ("a**(2/5)*a**(3/5)", "a"),
    ),
    *known(
        "nested radicals of numbers are numbers of the field",
        ("sqrt(3 + 2*sqrt(2))", "1 + sqrt(2)"),
        ("sqrt(6 - 2*sqrt(5))", "sqrt(5) - 1"),
        ("sin(pi/5)", "sqrt(10 - 2*sqrt(5))/4"),
        ("cos(pi/8)", "sqrt(2 + sqrt(2))/2"),
    ),
    *known(
        "the modulus of a root is the root of the modulus; a length is known to be real",
        ("abs(sqrt(x))", "sqrt(abs(x))"),
        ("abs(sqrt(x))**2", "abs(x)"),
        ("abs(x**(1/4))**4", "abs(x)"),
        ("abs(sqrt(-x**2 - 1))**2", "abs(x**2 + 1)"),
        ("abs(sqrt(x)*y)", "sqrt(abs(x))*abs(y)"),
        ("abs(sqrt(x**2 + y**2)*z)", "sqrt(x**2 + y**2)*abs(z)"),
        ("abs(sqrt(x**2 - 2*x*y + 2*y**2))", "sqrt(x**2 - 2*x*y + 2*y**2)"),
        ("abs(sqrt(x**2 + y**2 + 2*x*y*cos(z)))", "sqrt(x**2 + y**2 + 2*x*y*cos(z))"),
        ("abs(sqrt(5 - 4*cos(x)))", "sqrt(5 - 4*cos(x))"),
    ),
    *missed(
        "a radicand is known to be nowhere negative if it is a quadratic form whose pivots are squares or numbers",
        ("abs(sqrt(x**4 + x*y**3 + y**4))", "sqrt(x**4 + x*y**3 + y**4)"),
    ),
    *known(
        "the rational part of an exponent or of a factor is found beside roots, too",
        ("2**(sqrt(x**2 + y**2) + 1)", "2*2**sqrt(x**2 + y**2)"),
        ("2**(sqrt(x**2 + y**2) + z)", "2**sqrt(x**2 + y**2)*2**z"),
        ("2**(sqrt(2) + 1)", "2*2**sqrt(2)"),
        ("2**sqrt(3 + 2*sqrt(2))", "2*2**sqrt(2)"),
        ("z**(sqrt(x**2 + y**2) + 1)", "z*z**sqrt(x**2 + y**2)"),
        ("exp((sqrt(x**2 + y**2) + 1)*log(3))", "3*exp(sqrt(x**2 + y**2)*log(3))"),
        ("67**(1/sqrt(x**2 + y**2) + 2)", "4489*67**(1/sqrt(x**2 + y**2))"),
    ),
    *known(
        "the logarithm of what signs choose is that of what is chosen in each lane",
        ("log(Piecewise((exp(x), y), otherwise=exp(z)))", "Piecewise((x, y), otherwise=z)"),
        ("log(cosh(x) + sign(x)*sinh(x))", "abs(x)"),
        ("log(Max(exp(x), exp(y)))", "log(exp(Piecewise((x, exp(x) - exp(y)), otherwise=y)))"),
    ),
    *known(
        "the logarithm of a positive monomial is a sum",
        ("log(a*b)", "log(a) + log(b)"),
        ("log(a/b)", "log(a) - log(b)"),
        ("log(a**2)", "2*log(a)"),
        ("log(sqrt(a))", "log(a)/2"),
        ("log(a**x)", "x*log(a)"),
        ("log(2*a)", "log(2) + log(a)"),
        ("log(8)", "3*log(2)"),
        ("log(1/a)", "-log(a)"),
        ("log(a*exp(x))", "log(a) + x"),
        ("log(exp(y)*(a + x) - exp(y)*x)", "log(a) + y"),
        ("log(sinh(x) + cosh(x))", "x"),
        ("(3**x*(y + 1) - 3**x*y)**z", "3**(x*z)"),
        ("exp(2*log(a))", "a**2"),
        ("exp(x + 3*log(2))", "8*exp(x)"),
        ("exp(log(a)/3)", "a**(1/3)"),
        ("exp(x*log(a))", "a**x"),
        ("2**x", "exp(x*log(2))"),
        ("exp(2*log(3))", "9"),
    ),
    *known(
        "a power with a symbolic exponent is exp(exponent*log(base)), with log |base| + i*pi for a negative base",
        ("x**y*x**z", "x**(y + z)"),
        ("x*x**y", "x**(y + 1)"),
        ("(x**y)**2", "x**(2*y)"),
        ("exp(y*log(x))", "x**y"),
        ("exp(abs(y)*log(x))", "x**abs(y)"),
        ("exp(sin(y)*log(x))", "x**sin(y)"),
        ("x**Max(y, -y)", "x**abs(y)"),
        ("(-2)**(x + 1)", "-2*(-2)**x"),
        ("sign((x**2)**y)", "1"),
    ),
    *known(
        "in the fields of arguments, sines are real and have signs",
        ("sin(abs(sin(2*x)))", "sin(2*abs(sin(x)*cos(x)))"),
        ("exp(abs(sin(2*x)))", "exp(2*abs(sin(x)*cos(x)))"),
        ("cos(sqrt(1 - cos(x)**2))", "cos(abs(sin(x)))"),
    ),
    *missed(
        "a positive factor stays in the base of a symbolic power, and in a logarithm, if the rest may be negative",
        ("(2*x)**y", "2**y*x**y"),
        ("(a*x**2)**y", "a**y*(x**2)**y"),
        ("(x**2 + y**2)**z", "sqrt(x**2 + y**2)**(2*z)"),
        ("a*abs(x)**b", "a*(x**2)**(b/2)"),
        ("log(a*x**2)", "log(a) + log(x**2)"),
    ),
    *missed(
        "the sign of an irrational number is known for those of known angles alone, such as 1 + sqrt(2) = 1/tan(pi/8)",
        ("sqrt(4 + 2*sqrt(3))", "1 + sqrt(3)"),
        ("sqrt(5 + 2*sqrt(6))", "sqrt(2) + sqrt(3)"),
        ("abs(1 - sqrt(3))", "sqrt(3) - 1"),
        ("Max(3, pi)", "pi"),
    ),
    *missed(
        "an argument that holds a sign is not opened",
        ("tanh(abs(x))", "abs(tanh(x))"),
    ),
    *missed(
        "the order of the real numbers is not known",
        ("Max(abs(x), abs(y))", "(abs(x + y) + abs(x - y))/2"),
        ("Min(Max(x, -a), a)", "-Min(Max(-x, -a), a)"),
    ),
    *missed(
        "sums are no monomials: their logarithms are not related to those of their factors",
        ("log(a**2 + 2*a + 1)", "2*log(a + 1)"),
        ("log(a**2 + a*b)", "log(a) + log(a + b)"),
    ),
    *missed("atan2 is drawn for a direction, atan for a slope", ("atan2(x, a)", "atan(x/a)")),
    *known(
        "arc functions are points of the circle",
        ("cos(asin(x))", "sqrt(1 - x**2)"),
        ("cos(asin(x/67 + y))", "sqrt(1 - (x/67 + y)**2)"),
        ("tan(asin(x/67))", "x/sqrt(67**2 - x**2)"),
        ("cos(atan(37/101))*sqrt(11570)", "101"),
        ("sin(acos(x))", "sqrt(1 - x**2)"),
        ("sin(atan(x))", "x/sqrt(1 + x**2)"),
        ("cos(atan(x))", "1/sqrt(1 + x**2)"),
        ("cos(2*atan(x))", "(1 - x**2)/(1 + x**2)"),
        ("tan(atan2(y, x))", "y/x"),
        ("cos(atan2(y, x))", "x/sqrt(x**2 + y**2)"),
        ("sin(atan2(y, x))", "y/sqrt(x**2 + y**2)"),
        ("atan2(2*y, 2*x)", "atan2(y, x)"),
        ("atan2(a*y, a*x)", "atan2(y, x)"),
        ("atan2(-y, x)", "-atan2(y, x)"),
        ("asin(x) + acos(x)", "pi/2"),
    ),
    *missed(
        "an arc function of another function needs its range",
        ("atan(x) + atan(1/x)", "pi*sign(x)/2"),
        ("acos(cos(asin(x)))", "abs(asin(x))"),
    ),
    *known(
        "a condition enters with its sign",
        ("Piecewise((x, 2*y), otherwise=z)", "Piecewise((x, y), otherwise=z)"),
        ("Piecewise((x, a*y), otherwise=z)", "Piecewise((x, y), otherwise=z)"),
        ("Piecewise((2*x, y), otherwise=2*z)", "2*Piecewise((x, y), otherwise=z)"),
        ("Piecewise((x, x), otherwise=-x)", "abs(x)"),
        ("Piecewise((x, x - y), otherwise=y)", "Max(x, y)"),
        ("Piecewise((x, a*b), otherwise=y)", "x"),
    ),
    *known(
        "a value is complex if it depends on a complex symbol",
        ("(s*x + x)/(s + 1)", "x"),
        ("sqrt((s*x**2 + x**2)/(s + 1))", "abs(x)"),
        ("abs((s*x + x)/(s + 1))", "sign(x)*x"),
        ("log((s*exp(x) + exp(x))/(s + 1))", "x"),
    ),
)


@dataclass(frozen=True)
class Difference:
    """Two texts that look alike, and where they differ."""

    left: str
    right: str
    reason: str


DIFFERENCES: tuple[Difference, ...] = (
    Difference("abs(x)", "x", "x < 0"),
    Difference("abs(x)", "-x", "x > 0"),
    Difference("abs(sqrt(x))**2", "x", "x < 0"),
    Difference("abs(sqrt(-x**2 - 1))**2", "-x**2 - 1", "every x"),
    Difference("abs(x**(1/4))**4", "x", "x < 0"),
    Difference("abs(sqrt(x**2 - 3*x*y + 2*y**2))**2", "x**2 - 3*x*y + 2*y**2", "y < x < 2*y"),
    Difference("abs(sqrt(4 - 5*cos(x)))**2", "4 - 5*cos(x)", "x = 0"),
    Difference("abs(x**y)**2", "x**(2*y)", "x = -2, y = 1/2"),
    Difference("abs(sqrt(x) + 1)**2", "(sqrt(x) + 1)**2", "x < 0"),
    Difference("abs(x) + x", "0", "x > 0"),
    Difference("abs(x) - x", "0", "x < 0"),
    Difference("sign(x) + 1", "0", "x > 0"),
    Difference("sqrt(x**2) - x", "0", "x < 0"),
    Difference("Max(x, y) - y", "0", "x > y"),
    Difference("abs(67*x)", "-67*abs(x)", "every x"),
    Difference("abs(x + y)", "abs(x) + abs(y)", "x < 0 < y"),
    Difference("sqrt(x**2)", "x", "x < 0"),
    Difference("sqrt(x*y)", "sqrt(x)*sqrt(y)", "x and y < 0"),
    Difference("sqrt(x + y)", "sqrt(x) + sqrt(y)", "almost everywhere"),
    Difference("sqrt(-x)", "sqrt(x)", "almost everywhere"),
    Difference("(x**3)**(1/3)", "x", "x < 0"),
    Difference("(x**6)**(1/3)", "x**3", "x < 0"),
    Difference("(x**13)**(1/13)", "x", "x < 0"),
    Difference("x**(1/13) + (-x)**(1/13)", "0", "every x"),
    Difference("(sqrt(x) + 1)**(1/3)*(sqrt(x) + 2)**(1/3)", "-((sqrt(x) + 1)*(sqrt(x) + 2))**(1/3)", "x > 0"),
    Difference("sqrt(x)**(2/3)", "abs(x)**(1/3)", "x < 0"),
    Difference("sqrt(x**4 - 2*x**2 + 1)", "x**2 - 1", "-1 < x < 1"),
    Difference("sign(x)", "1", "x < 0"),
    Difference("sign(x)", "sign(y)", "x < 0 < y"),
    Difference("sign(x*y)", "sign(x)", "y < 0"),
    Difference("Max(x, y)", "x", "x < y"),
    Difference("Max(x, y)", "Max(x, z)", "y > x, z"),
    Difference("Max(-2*x, -2*y)", "-2*Max(x, y)", "almost everywhere"),
    Difference("abs(x)**y", "x**y", "x = -2, y = 3"),
    Difference("(x**2)**y", "x**(2*y)", "x = -2, y = 1/2"),
    Difference("exp(Max(0, sin(x)**2))", "1", "almost everywhere"),
    Difference("cos(abs(sin(x)) + sin(x))", "1", "sin(x) > 0"),
    Difference("2**sign(x)", "2", "x < 0"),
    Difference("2**sign(x)", "Piecewise((2, y), otherwise=1/2)", "x < 0 < y"),
    Difference("cos(pi*sign(x)/3 + pi/3)", "1", "x > 0"),
    Difference("log(x**2)", "2*log(x)", "x < 0"),
    Difference("log(x*y)", "log(x) + log(y)", "x and y < 0"),
    Difference("exp(log(x**2)/2)", "x", "x < 0"),
    Difference("atan2(2*y, -2*x)", "atan2(y, x)", "almost everywhere"),
    Difference("atan2(y*z, x*z)", "atan2(y, x)", "z < 0"),
    Difference("atan2(y, x)", "atan(y/x)", "x < 0"),
    Difference("asin(sin(x))", "x", "x > pi/2"),
    Difference("cos(asin(x))", "-sqrt(1 - x**2)", "-1 < x < 1"),
    Difference("Piecewise((x, -y), otherwise=z)", "Piecewise((x, y), otherwise=z)", "almost everywhere"),
    Difference("Piecewise((x, y*z), otherwise=z)", "Piecewise((x, y), otherwise=z)", "z < 0"),
    Difference("sqrt(((s + 1)*x**2 + s)/(s + 1))", "abs(x)", "almost everywhere"),
    Difference("sqrt(exp(s))", "exp(s/2)", "complex s with an imaginary part beyond pi"),
    Difference("sqrt(s**2)", "s", "complex s with a negative real part"),
    Difference("log(exp(s))", "s", "complex s with an imaginary part beyond pi"),
    Difference("abs(s)**2", "s**2", "complex s"),
    Difference("sqrt(s*a)**2", "a*abs(s)", "complex s"),
    Difference("sqrt(3 - 2*sqrt(2))", "1 - sqrt(2)", "the number is positive"),
    Difference("67**(1/3)", "109**(1/3)", "the numbers differ"),
)


# --- the tables of the document --------------------------------------------------------------------------------------


def tables() -> str:
    """Return the rows as the document shows them."""
    rows = (
        (_code(each.left, each.right, "=="), "known" if each.is_known else "**missed**", each.reason)
        for each in EQUALITIES
    )
    differences = ((_code(each.left, each.right, "!="), each.reason) for each in DIFFERENCES)
    return "\n".join(
        (
            *_table(("equality", "`==`", "why"), rows),
            "",
            "These pairs look alike, are never equal, and differ where the second column says:",
            "",
            *_table(("pair", "differs for"), differences),
        )
    )


def _code(left: str, right: str, sign: str) -> str:
    return f"`{left} {sign} {right}`".replace("|", "\\|")


def _table(titles: tuple[str, ...], rows: Iterator[tuple[str, ...]]) -> Iterator[str]:
    yield f"| {' | '.join(titles)} |"
    yield f"|{'---|' * len(titles)}"
    yield from (f"| {' | '.join(row)} |" for row in rows)


def written(document: str) -> str:
    """Return the document with the present tables."""
    before, rest = document.split(BEGIN)
    after = rest.split(END)[1]
    return f"{before}{BEGIN}\n\n{tables()}\n\n{END}{after}"


if __name__ == "__main__":
    DOCUMENT.write_text(written(DOCUMENT.read_text()))
