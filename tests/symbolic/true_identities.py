"""Identities that fingerprints know, family by family, as pairs of texts (see reading.py).

The families follow DESIGN section 1.1: the circle's and the multiplicative group, the angles 2 pi k/110880, square
roots of rationals, field arithmetic, exact decimals, and congruence (equal arguments give equal values).
"""

from __future__ import annotations

from collections.abc import Iterator

Pair = tuple[str, str]


def chebyshev(n: int, *, kind: int, of: str) -> str:
    """Return the Chebyshev polynomial T_n (kind 1) or U_n (kind 2) by its recurrence, in nested text."""
    older, newer = "1", f"{kind}*({of})"
    for _ in range(n):
        older, newer = newer, f"2*({of})*({newer}) - ({older})"
    return older


def multiple_angles() -> Iterator[Pair]:
    for n in range(2, 11):
        yield f"cos({n}*x)", chebyshev(n, kind=1, of="cos(x)")
        yield f"sin({n}*x)", f"sin(x)*({chebyshev(n - 1, kind=2, of='cos(x)')})"
        yield f"cosh({n}*x)", chebyshev(n, kind=1, of="cosh(x)")
        yield f"sinh({n}*x)", f"sinh(x)*({chebyshev(n - 1, kind=2, of='cosh(x)')})"
    for n in (16, 25, 40, 64):  # by doubling, not by a polynomial
        yield f"sin({2 * n}*x)", f"2*sin({n}*x)*cos({n}*x)"
        yield f"cos({2 * n}*x)", f"1 - 2*sin({n}*x)**2"


def fractions_of_angles() -> Iterator[Pair]:
    for n in range(2, 13):
        yield "cos(x)", chebyshev(n, kind=1, of=f"cos(x/{n})")
        yield "sin(x*y)", f"sin(x*y/{n})*({chebyshev(n - 1, kind=2, of=f'cos(x*y/{n})')})"
    yield "sin(x/2)**2", "(1 - cos(x))/2"
    yield "cos(x/2)**2", "(1 + cos(x))/2"
    yield "tan(x/2)", "sin(x)/(1 + cos(x))"
    yield "tan(x/2)", "(1 - cos(x))/sin(x)"
    yield "tan(x/4)", "sin(x/2)/(1 + cos(x/2))"
    yield "sin(x)", "2*tan(x/2)/(1 + tan(x/2)**2)"
    yield "cos(x)", "(1 - tan(x/2)**2)/(1 + tan(x/2)**2)"
    yield "sin(5*x/6)", "sin(x/2)*cos(x/3) + cos(x/2)*sin(x/3)"
    yield "cos(x/6)", "cos(x/2)*cos(x/3) + sin(x/2)*sin(x/3)"


def sums_of_angles() -> Iterator[Pair]:
    sine, cosine, angles = "sin(x)", "cos(x)", ["x"]
    for more in ("y", "2*u", "v/3", "pi/5", "(-w)", "5*x*y", "x1"):
        sine, cosine = (
            f"(({sine})*cos({more}) + ({cosine})*sin({more}))",
            f"(({cosine})*cos({more}) - ({sine})*sin({more}))",
        )
        angles.append(more)
        yield f"sin({' + '.join(angles)})", sine
        yield f"cos({' + '.join(reversed(angles))})", cosine
    yield "sin(x + y) + sin(x - y)", "2*sin(x)*cos(y)"
    yield "sin(x + y)*sin(x - y)", "sin(x)**2 - sin(y)**2"
    yield "cos(x + y)*cos(x - y)", "cos(x)**2 - sin(y)**2"
    yield "sin(x - y) + sin(y - z) + sin(z - x)", "-4*sin((x - y)/2)*sin((y - z)/2)*sin((z - x)/2)"
    yield ("sin(x) + sin(y) + sin(z) - sin(x + y + z)", "4*sin((x + y)/2)*sin((y + z)/2)*sin((z + x)/2)")
    yield "sin(x)*sin(y - z) + sin(y)*sin(z - x) + sin(z)*sin(x - y)", "0"
    yield "sin(x0 - x0/2)", "sin(x0/2)"


def products_to_sums() -> Iterator[Pair]:
    for m, n in ((1, 1), (1, 2), (2, 3), (3, 7), (5, 4), (9, 2)):
        yield f"sin({m}*x)*cos({n}*y)", f"(sin({m}*x + {n}*y) + sin({m}*x - {n}*y))/2"
        yield f"sin({m}*x)*sin({n}*y)", f"(cos({m}*x - {n}*y) - cos({m}*x + {n}*y))/2"
        yield f"cos({m}*x)*cos({n}*x)", f"(cos({m - n}*x) + cos({m + n}*x))/2"
        yield f"sin({m}*x) + sin({n}*y)", f"2*sin(({m}*x + {n}*y)/2)*cos(({m}*x - {n}*y)/2)"
    yield "sin(x)**4", "(3 - 4*cos(2*x) + cos(4*x))/8"
    yield "cos(x)**5", "(10*cos(x) + 5*cos(3*x) + cos(5*x))/16"
    yield "sin(x)**3*cos(x)**2", "(2*sin(x) + sin(3*x) - sin(5*x))/16"
    for n in (3, 8, 15):  # the Dirichlet kernel and a product of cosines
        yield " + ".join(f"cos({k}*x)" for k in range(1, n + 1)), f"sin({2 * n + 1}*x/2)/(2*sin(x/2)) - 1/2"
    yield "*".join(f"cos({2**k}*x)" for k in range(6)), "sin(64*x)/(64*sin(x))"


def tangents() -> Iterator[Pair]:
    yield "tan(x)", "sin(x)/cos(x)"
    yield "1 + tan(x)**2", "1/cos(x)**2"
    yield "tan(x + y)", "(tan(x) + tan(y))/(1 - tan(x)*tan(y))"
    yield "tan(2*x)", "2*tan(x)/(1 - tan(x)**2)"
    yield "tan(3*x)", "tan(x)*tan(pi/3 - x)*tan(pi/3 + x)"
    yield "tan(x) + 1/tan(x)", "2/sin(2*x)"
    yield "tan(x - y) + tan(y - z) + tan(z - x)", "tan(x - y)*tan(y - z)*tan(z - x)"
    yield "tan(pi/4 + x)", "(cos(x) + sin(x))/(cos(x) - sin(x))"
    yield "tan(x + pi/2)", "-1/tan(x)"
    yield "tan(-x)", "-tan(x)"
    yield "tan(x + y)*(1 - tan(x)*tan(y)) - tan(y)", "tan(x)"
    yield "tanh(2*x)", "2*tanh(x)/(1 + tanh(x)**2)"
    yield "tanh(x)", "1 - 2/(exp(2*x) + 1)"


def turned_angles() -> Iterator[Pair]:
    for k in range(-5, 6):
        sine = ("sin(x)", "cos(x)", "-sin(x)", "-cos(x)")[k % 4]
        cosine = ("cos(x)", "-sin(x)", "-cos(x)", "sin(x)")[k % 4]
        yield f"sin(x + {k}*pi/2)", sine
        yield f"cos({k}*pi/2 + x)", cosine
    yield "sin(pi - x)", "sin(x)"
    yield "cos(2*pi/3 + x) + cos(x) + cos(x - 2*pi/3)", "0"
    yield "sin(x)**2 + sin(x + 2*pi/3)**2 + sin(x + 4*pi/3)**2", "3/2"
    yield "sin(x + pi/4)", "(sin(x) + cos(x))/sqrt(2)"
    yield "cos(x + pi/6)", "(sqrt(3)*cos(x) - sin(x))/2"
    yield "4*sin(x)*sin(pi/3 - x)*sin(pi/3 + x)", "sin(3*x)"
    yield "sin(x + 100*pi)", "sin(x)"
    yield "sin((2*x + pi)/2)", "cos(x)"


SINES_OF_TWELFTHS = (
    "0",
    "(sqrt(6) - sqrt(2))/4",
    "1/2",
    "sqrt(2)/2",
    "sqrt(3)/2",
    "(sqrt(6) + sqrt(2))/4",
    "1",
)


def exact_twelfths() -> Iterator[Pair]:
    for k in range(25):
        quarter, rest = divmod(k, 6)
        value = SINES_OF_TWELFTHS[rest if quarter % 2 == 0 else 6 - rest]
        yield f"sin({k}*pi/12)", value if quarter < 2 or k == 12 else f"-({value})"
    yield "tan(pi/12)", "2 - sqrt(3)"
    yield "tan(pi/12 + pi/3)", "2 + sqrt(3)"
    yield "tan(pi/8)", "sqrt(2) - 1"
    yield "cos(pi/8)**2", "(2 + sqrt(2))/4"


def exact_fifths_and_sixtieths() -> Iterator[Pair]:
    for k in (0, 1, 2, 3, 4, 5, 6, 7, 8, 9):
        value = ("1", "(1 + sqrt(5))/4", "(sqrt(5) - 1)/4", "(1 - sqrt(5))/4", "-(1 + sqrt(5))/4", "-1")[
            min(k, 10 - k)
        ]
        yield f"cos({k}*pi/5)", value
    yield "sin(pi/10)", "(sqrt(5) - 1)/4"
    yield "sin(3*pi/10)", "(sqrt(5) + 1)/4"
    yield "sin(pi/5)**2", "(5 - sqrt(5))/8"
    yield "sin(pi/5)*sin(2*pi/5)", "sqrt(5)/4"
    for k in range(1, 60, 2):  # k/60 = p/12 + q/5
        p, q = 5 * k % 12, 0
        while (5 * p + 12 * q - k) % 120:
            q += 1
            if q == 10:
                p, q = p + 12, 0
        yield f"sin({k}*pi/60)", f"sin({p}*pi/12)*cos({q}*pi/5) + cos({p}*pi/12)*sin({q}*pi/5)"


def roots_of_unity() -> Iterator[Pair]:
    for n in range(3, 13):
        yield " + ".join(f"cos(2*pi*{k}/{n})" for k in range(n)), "0"
        yield "*".join(f"sin({k}*pi/{n})" for k in range(1, n)), f"{n}/2**{n - 1}"
        yield " + ".join(f"sin(x + 2*{k}*pi/{n})" for k in range(n)), "0"
    yield "cos(pi/7)*cos(2*pi/7)*cos(4*pi/7)", "-1/8"
    yield "cos(pi/9)*cos(2*pi/9)*cos(4*pi/9)", "1/8"
    yield "tan(3*pi/11) + 4*sin(2*pi/11)", "sqrt(11)"
    yield "tan(pi/7)*tan(2*pi/7)*tan(3*pi/7)", "sqrt(7)"
    yield "8*sin(pi/18)**3 - 6*sin(pi/18)", "-1"
    for prime, wave in ((3, "sin"), (5, "cos"), (7, "sin"), (11, "sin")):
        squares = {k * k % prime for k in range(1, prime)}
        signs = ((k, "+" if k in squares else "-") for k in range(1, prime))
        yield "".join(f" {sign} {wave}(2*{k}*pi/{prime})" for k, sign in signs), f"sqrt({prime})"


def exponentials() -> Iterator[Pair]:
    yield "exp(x)*exp(y)", "exp(x + y)"
    yield "exp(x)*exp(-x)", "1"
    yield "exp(x - y)", "exp(x)/exp(y)"
    yield "exp(x/2)**2", "exp(x)"
    yield "exp(x/3)**3*exp(y/4)**4", "exp(x + y)"
    yield "exp(7*x)", "exp(x)**7"
    yield "exp(2)", "exp(1)**2"
    yield "exp(0)", "1"
    yield "cosh(x)**2 - sinh(x)**2", "1"
    yield "cosh(x) + sinh(x)", "exp(x)"
    yield "cosh(x)", "(exp(x) + exp(-x))/2"
    yield "sinh(x + y)", "sinh(x)*cosh(y) + cosh(x)*sinh(y)"
    yield "cosh(x - y)", "cosh(x)*cosh(y) - sinh(x)*sinh(y)"
    yield "sinh(x)*cosh(y)", "(sinh(x + y) + sinh(x - y))/2"
    yield "tanh(x + y)", "(tanh(x) + tanh(y))/(1 + tanh(x)*tanh(y))"
    yield "1 - tanh(x)**2", "1/cosh(x)**2"
    yield "sinh(x/2)**2", "(cosh(x) - 1)/2"
    yield "tanh(x/2)", "sinh(x)/(cosh(x) + 1)"
    yield "exp(x)*sin(y)*exp(-x)", "sin(y)"
    yield "(exp(x) - exp(-x))*(exp(x) + exp(-x))", "2*sinh(2*x)"
    yield "exp(log(a))", "a"
    yield "log(exp(x))", "x"
    yield "sinh(-x)", "-sinh(x)"
    yield "cosh(x*y - z)", "cosh(z - x*y)"


def rational_functions() -> Iterator[Pair]:
    for n in range(2, 10):
        yield f"(x**{n} - 1)/(x - 1)", " + ".join(f"x**{k}" for k in range(n))
        yield f"(x - y)*({' + '.join(f'x**{k}*y**{n - 1 - k}' for k in range(n))})", f"x**{n} - y**{n}"
    for i, j in ((1, 2), (2, 5), (3, 11)):
        yield f"1/((x + {i})*(x + {j}))", f"(1/(x + {i}) - 1/(x + {j}))/{j - i}"
    yield "1/(1/x + 1/y)", "x*y/(x + y)"
    yield "1/(1 + 1/(1 + 1/(1 + 1/x)))", "(2*x + 1)/(3*x + 2)"
    yield "(x**2 - y**2)/(x + y)", "x - y"
    yield "(a**2 + b**2)*(x**2 + y**2)", "(a*x + b*y)**2 + (a*y - b*x)**2"
    yield "x/y + y/x", "(x**2 + y**2)/(x*y)"
    yield "(x + y + z)**3 - x**3 - y**3 - z**3", "3*(x + y)*(y + z)*(z + x)"
    yield "x**3 + y**3 + z**3 - 3*x*y*z", "(x + y + z)*(x**2 + y**2 + z**2 - x*y - y*z - z*x)"
    yield "(y - z)/(x - z)*(x - z)/(y - z)", "1"
    yield "1/((x - y)*(x - z)) + 1/((y - x)*(y - z)) + 1/((z - x)*(z - y))", "0"
    yield "x/((x - y)*(x - z)) + y/((y - x)*(y - z)) + z/((z - x)*(z - y))", "0"
    yield "x**2/((x - y)*(x - z)) + y**2/((y - x)*(y - z)) + z**2/((z - x)*(z - y))", "1"
    yield "x**4 + 4*y**4", "(x**2 + 2*x*y + 2*y**2)*(x**2 - 2*x*y + 2*y**2)"
    yield "(x**5)**2/x**9", "x"
    yield "x**(-3)*x**4", "x"
    yield "((x + 1)**2 - 1)/x", "x + 2"
    yield "x*(y*(z + 1) + 1) + 1", "x*y*z + x*y + x + 1"
    yield "(x + y)*(u + v) - x*u - x*v - y*u", "y*v"
    yield "x - (y - (z - (u - (v - w))))", "x - y + z - u + v - w"
    yield "(x0*x1)**2/x1", "x0**2*x1"


def binomials() -> Iterator[Pair]:
    for n in range(2, 12):
        row = [1]
        for k in range(n):
            row.append(row[-1] * (n - k) // (k + 1))
        yield f"(x + y)**{n}", " + ".join(f"{c}*x**{n - k}*y**{k}" for k, c in enumerate(row))
        yield (
            f"(sin(x) - 2*z)**{n}",
            " + ".join(f"{c}*sin(x)**{n - k}*(-2*z)**{k}" for k, c in enumerate(row)),
        )


def radicals() -> Iterator[Pair]:
    factors = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31)
    for i, m in enumerate(factors):
        for n in factors[i + 1 :]:
            yield f"sqrt({m})*sqrt({n})", f"sqrt({m * n})"
        yield f"sqrt({m})**2", f"{m}"
        yield f"sqrt({m}/{m + 2})*sqrt({m + 2})", f"sqrt({m})"
        yield f"sqrt({4 * m})", f"2*sqrt({m})"
        yield f"1/sqrt({m})", f"sqrt({m})/{m}"
    for m in range(1, 12):
        yield f"1/(sqrt({m + 1}) - sqrt({m}))", f"sqrt({m + 1}) + sqrt({m})"
        yield f"sqrt({m * m})", f"{m}"
    yield "(1 + sqrt(2))*(sqrt(2) - 1)", "1"
    yield "(sqrt(2) + sqrt(3))**4", "49 + 20*sqrt(6)"
    yield "((1 + sqrt(5))/2)**10 + ((1 - sqrt(5))/2)**10", "123"
    yield "(((1 + sqrt(5))/2)**20 - ((1 - sqrt(5))/2)**20)/sqrt(5)", "6765"
    yield "sqrt(2)*sqrt(3)*sqrt(5)*sqrt(7)*sqrt(11)*sqrt(13)", "sqrt(30030)"
    yield "sqrt(1/2)", "sqrt(2)/2"
    yield "sqrt(12/25)", "2*sqrt(3)/5"
    yield "sqrt(0.25)", "1/2"
    yield "sqrt(0.02)", "sqrt(2)/10"
    yield "sqrt(x)**6", "x**3"
    yield "1/sqrt(x)*x", "sqrt(x)"
    yield "x**(3/2)/sqrt(x)", "x"
    yield "sqrt(sin(x)**2 + cos(x)**2)", "1"
    yield "sqrt((x + y)**2)", "sqrt(x**2 + 2*x*y + y**2)"
    yield "sqrt(a**2)", "a"
    yield "sqrt(a)*sqrt(a)", "a"
    yield "sqrt(37)**2", "37"
    yield "2**(3/2)", "2*sqrt(2)"
    yield "8**(1/2) - 2**(1/2)", "sqrt(2)"


def decimals() -> Iterator[Pair]:
    yield "0.1 + 0.2", "0.3"
    yield "0.6**2 + 0.8**2", "1"
    yield "0.1*3", "0.3"
    yield "1.1*1.1", "1.21"
    yield "0.1**3", "0.001"
    yield "2.5", "5/2"
    yield "1e-3*1e3", "1"
    yield "1e22 + 1", "10000000000000000000001"
    yield "0.1 + 0.1 + 0.1 + 0.1 + 0.1 + 0.1 + 0.1 + 0.1 + 0.1 + 0.1", "1"
    yield "(0.7 + 0.1)*10", "8"
    yield "0.3/0.1", "3"
    yield "1.0/3.0", "1/3"
    yield "1e-200*1e-200*1e200*1e200", "1"
    yield "1e300*1e300*1e-300*1e-300", "1"
    yield "x + 0.1 + 0.2 - 0.3", "x"
    yield "0.1*x + 0.2*x", "0.3*x"
    yield "sin(0.1*x + 0.2*x)", "sin(0.3*x)"
    yield "sin(0.1 + 0.2)", "sin(0.3)"
    yield "sin(0.5*x)*cos(0.5*x)", "0.5*sin(x)"
    yield "exp(0.1)*exp(0.2)", "exp(0.3)"
    yield "x**0.5", "sqrt(x)"
    yield "x**2.0", "x*x"
    yield "sqrt(0.09)", "0.3"
    yield "9.81*0.7*0.8 - 9.81*0.56", "0"
    yield "cos(0.5*pi)", "0"
    yield "sin(0.25*pi)", "sqrt(0.5)"
    yield "(x + 0.1)*(x - 0.1)", "x**2 - 0.01"
    yield "0.28**2 + 0.96**2", "1"
    for k in range(1, 20):
        yield f"{k / 10!r} + {(k + 3) / 10!r}", f"{2 * k + 3}/10"


def derivatives() -> Iterator[Pair]:
    yield "D(sin(x)**2 + cos(x)**2, x)", "0"
    yield "D(sin(2*x), x)", "2*(cos(x)**2 - sin(x)**2)"
    yield "D(2*sin(x)*cos(x), x)", "2*cos(2*x)"
    yield "D(tan(x), x)", "1 + tan(x)**2"
    yield "D(1/tan(x), x)", "-1/sin(x)**2"
    yield "D(atan(x), x)", "1/(1 + x**2)"
    yield "D(asin(x), x)", "1/sqrt(1 - x**2)"
    yield "D(asin(x) + acos(x), x)", "0"
    yield "D(log(x), x)*x", "1"
    yield "D(log(x*y), x)", "D(log(x) + log(y), x)"
    yield "D(log(sin(x)), x)", "1/tan(x)"
    yield "D(sqrt(x), x)*sqrt(x)", "1/2"
    yield "D(sqrt(x**2 + 1), x)", "x/sqrt(x**2 + 1)"
    yield "D(exp(x*y), x)", "y*exp(x*y)"
    yield "D(exp(-x**2/2), x)", "-x*exp(-x**2/2)"
    yield "D(tanh(x), x)", "1 - tanh(x)**2"
    yield "D(cosh(x)**2, x)", "sinh(2*x)"
    yield "D(atan2(y, x), x)", "-y/(x**2 + y**2)"
    yield "D(atan2(y, x), y)", "x/(x**2 + y**2)"
    yield "D(atan((x + y)/(1 - x*y)), x)", "D(atan(x), x)"
    yield "D(x**7, x)", "7*x**6"
    yield "D(x*D(x**3, x), x)", "9*x**2"
    yield "D(D(sin(3*x), x), x)", "-9*sin(3*x)"
    yield "D((x**2 - y**2)/(x - y), x)", "1"
    yield "D(cos(x + y), x)", "D(cos(x + y), y)"
    yield "D(sin(x)*sin(y), x)", "(sin(x + y) - sin(x - y))/2"
    yield "D(a**x, x)/a**x", "log(a)"
    yield "D(x/(1 + x), x)", "1/(1 + x)**2"


def congruences() -> Iterator[Pair]:
    """Equal arguments give equal values, however the arguments are written."""
    arguments = (
        ("x*(y + z)", "x*y + x*z"),
        ("(x + y)**2", "x**2 + 2*x*y + y**2"),
        ("sin(x)**2 + cos(x)**2", "1"),
        ("x - (x - y)", "y"),
        ("x1*(x0 + 1)", "x0*x1 + x1"),
        ("sqrt(6)*x", "sqrt(2)*sqrt(3)*x"),
        ("0.1*x + 0.2*x", "0.3*x"),
    )
    for function in ("sin", "cos", "tan", "exp", "tanh", "cosh", "sqrt", "log", "abs", "atan", "f", "sign"):
        for one, two in arguments:
            if function == "abs" and one == "(x + y)**2":
                continue  # an even power leaves its modulus by form: a square that is multiplied out does not
            yield f"{function}({one})", f"{function}({two})"
    for function in ("log", "atan", "f"):  # known by nothing but their argument's value
        yield f"{function}(x*sin(2*y))", f"{function}(2*x*sin(y)*cos(y))"
        yield f"{function}((x**2 - 1)/(x + 1))", f"{function}(x - 1)"
    yield "atan2(2*sin(x)*cos(x), x*(y + z))", "atan2(sin(2*x), x*y + x*z)"
    yield "Max(x + y, sin(x)**2)", "Max(y + x, 1 - cos(x)**2)"
    yield "f(x - x, sin(x + y))", "f(0, sin(y + x))"
    yield "sin(x*(y + z))", "sin(x*y)*cos(x*z) + cos(x*y)*sin(x*z)"
    yield "sin(2*x*(y + z))", "2*sin(x*y + x*z)*cos(x*(y + z))"
    yield "exp((x + y)**2)", "exp(x**2)*exp(y**2)*exp(2*x*y)"
    yield "cos((x + y)*(x - y))", "cos(x**2)*cos(y**2) + sin(x**2)*sin(y**2)"
    yield "sin(asin(x))", "x"
    yield "cos(acos(x))", "x"
    yield "tan(atan(x))", "x"
    yield "abs(-x)", "abs(x)"
    yield "abs(x)**2", "x**2"
    yield "Min(x, y)", "Min(y, x)"


def rotations() -> Iterator[Pair]:
    """Rows of the matrix of the Euler angles z-x-z are orthonormal, whichever angles."""
    rows = (
        ("cos(x)*cos(z) - sin(x)*cos(y)*sin(z)", "-cos(x)*sin(z) - sin(x)*cos(y)*cos(z)", "sin(x)*sin(y)"),
        ("sin(x)*cos(z) + cos(x)*cos(y)*sin(z)", "-sin(x)*sin(z) + cos(x)*cos(y)*cos(z)", "-cos(x)*sin(y)"),
        ("sin(y)*sin(z)", "sin(y)*cos(z)", "cos(y)"),
    )
    for i, p in enumerate(rows):
        for j, q in enumerate(rows):
            yield " + ".join(f"({a})*({b})" for a, b in zip(p, q, strict=True)), "1" if i == j else "0"
            following = rows[3 - i - j] if i != j else None
            if following:
                sign = "" if (j - i) % 3 == 1 else "-"
                yield f"({p[1]})*({q[2]}) - ({p[2]})*({q[1]})", f"{sign}({following[0]})"


FAMILIES = (
    multiple_angles,
    fractions_of_angles,
    sums_of_angles,
    products_to_sums,
    tangents,
    turned_angles,
    exact_twelfths,
    exact_fifths_and_sixtieths,
    roots_of_unity,
    exponentials,
    rational_functions,
    binomials,
    radicals,
    decimals,
    derivatives,
    congruences,
    rotations,
)
