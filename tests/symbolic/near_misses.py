"""Pairs of texts that look alike and differ (see reading.py): what a fingerprint must never confuse.

Besides the classical traps of algebra there are those of this method: numbers that agree modulo a prime of the field,
angles and exponents that agree modulo the order of a group. An expression's value is known at two points, so it takes
a number that hits both orders at once to fool it. The least of those have 27 digits, and nobody writes them but on
purpose: multiples and exponents are held here below 2**80. Plain numbers are exact at any size.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from tests.symbolic.true_identities import Pair

P, Q = 7591768160842071359, 5769354732605624159  # the primes of the two fingerprint words
ANGLES = (1801798093919, 4002493848239)  # orders of the groups of atomic angles, factors of P + 1 and Q + 1
EXPONENTS = (
    3795884080421035679,
    2884677366302812079,
)  # orders of the groups of exponentials, of P - 1 and Q - 1


def branches() -> Iterator[Pair]:
    for text in ("x", "x*y", "sin(x)", "x - y", "x**3", "x1"):
        yield f"sqrt(({text})**2)", text
        yield f"sqrt(({text})**2)", f"-({text})"
        yield f"abs({text})", text
        yield f"abs({text})", f"-({text})"
        yield f"sign({text})", "1"
        yield f"sign({text})*({text})", text
    yield "sqrt(x*y)", "sqrt(x)*sqrt(y)"
    yield "sqrt(x/y)", "sqrt(x)/sqrt(y)"
    yield "sqrt(1/x)", "1/sqrt(x)"
    yield "sqrt(x**3)", "x*sqrt(x)"
    yield "sqrt(x**2*y)", "x*sqrt(y)"
    yield "sqrt(x**2 + y**2)", "x + y"
    yield "sqrt(1 - sin(x)**2)", "cos(x)"
    yield "sqrt(1 - cos(x)**2)", "sin(x)"
    yield "sqrt((1 + cos(x))/2)", "cos(x/2)"
    yield "sqrt((x - y)**2)", "x - y"
    yield "sqrt(a - b)**2", "b - a"
    yield "(x**2)**(1/2)", "x"
    yield "(x**4)**(1/4)", "x"
    yield "(x**6)**(1/3)", "x**3"
    yield "abs(x + y)", "abs(x) + abs(y)"
    yield "abs(x)*y", "x*abs(y)"
    yield "abs(x)**3", "x**3"
    yield "sign(x)", "sign(y)"
    yield "sign(x)", "x"
    yield "Max(x, y)", "Min(x, y)"
    yield "Max(x, y)", "x"
    yield "Max(x, y)", "Max(x, z)"
    yield "Max(x, -x)", "x"
    yield "Min(x, 0)", "0"


def inverses() -> Iterator[Pair]:
    yield "asin(sin(x))", "x"
    yield "acos(cos(x))", "x"
    yield "atan(tan(x))", "x"
    yield "atan2(sin(x), cos(x))", "x"
    yield "asin(sin(x))", "pi - x"
    yield "asin(x)", "acos(x)"
    yield "acos(-x)", "acos(x)"
    yield "atan2(y, x)", "atan(y/x)"
    yield "atan2(y, x)", "atan2(x, y)"
    yield "atan2(y, x)", "atan2(-y, -x)"
    yield "atan2(y, x)", "atan2(y, -x)"
    yield "atan2(y, x)", "-atan2(y, -x)"
    yield "atan2(y*z, x*z)", "atan2(y, x)"
    yield "atan2(y, x) + atan2(x, y)", "pi/2"
    yield "atan2(y, x) + atan2(v, u)", "atan2(y*u + x*v, x*u - y*v)"
    yield "2*atan2(y, x)", "atan2(2*x*y, x**2 - y**2)"
    yield "atan(x) + atan(y)", "atan((x + y)/(1 - x*y))"
    yield "atan(x) + atan(1/x)", "pi/2"
    yield "log(x*y)", "log(x) + log(y)"
    yield "log(x/y)", "log(x) - log(y)"
    yield "log(x**2)", "2*log(x)"
    yield "log(1/x)", "-log(x)"
    yield "log(x + y)", "log(x) + log(y)"
    yield "log(-x)", "log(x)"
    yield "(x**y)**z", "x**(y*z)"
    yield "(x*y)**z", "x**z*y**z"
    yield "exp(x*y)", "exp(x)*exp(y)"
    yield "exp(x)*y", "exp(x*y)"
    yield "exp(x) + exp(y)", "exp(x + y)"
    yield "exp(-x)", "exp(x)"
    yield "exp(x**2)", "exp(x)**2"


MULTIPLES = (
    1,
    2,
    3,
    4,
    5,
    6,
    7,
    8,
    10,
    12,
    15,
    24,
    30,
    60,
    99,
    100,
    120,
    1000,
    110880,
    10**6,
    10**9,
    2**31,
    2**32,
    2**61,
    2**62,
    2**63,
    2**64,
    P,
    Q,
    P + 1,
    Q + 1,
    P - 1,
    Q - 1,
    10**20,
)


def multiples_off_by_one() -> Iterator[Pair]:
    for n in MULTIPLES:
        yield f"sin({n}*x)", f"sin({n + 1}*x)"
        yield f"cos({n}*x)", f"cos({n + 1}*x)"
        yield f"cos(x/{n})", f"cos(x/{n + 1})"
        yield f"exp({n}*x)", f"exp({n + 1}*x)"
        yield f"x**{n}", f"x**{n + 1}"
        yield f"{n}*x", f"{n + 1}*x"
        yield f"f({n}*x)", f"f({n + 1}*x)"
    for n in range(2, 40):
        yield f"sin(pi/{n})", f"sin(pi/{n + 1})"
        yield f"sin(x/{n})", f"sin(x)/{n}"
        yield f"cos({n}*x)", f"cos(x)**{n}"
        yield f"sin({n}*x)", f"{n}*sin(x)"
    yield "sin(100*x)", "sin(101*x)"
    yield "sin(100*x)", "-sin(100*x)"
    yield "tan(7*x)", "tan(8*x)"
    yield "sinh(2*x)", "2*sinh(x)"


def angles_modulo_the_circle() -> Iterator[Pair]:
    for n in (P + 1, Q + 1, (P + 1) // 2, 110880, *ANGLES, 6 * ANGLES[0], 110880 * ANGLES[1]):
        yield f"sin({n}*x)", "0"
        yield f"cos({n}*x)", "1"
        yield f"cos({n}*x)", "-1"
        yield f"cos({n + 1}*x)", "cos(x)"
        yield f"sin({n}*x + y)", "sin(y)"
        yield f"tan({n}*x)", "0"
    for n in (P - 1, Q - 1, (P - 1) // 2, *EXPONENTS, 6 * EXPONENTS[1]):
        yield f"exp({n}*x)", "1"
        yield f"x**{n}", "1"
        yield f"x**{n + 1}", "x"
        yield f"cosh({n}*x)", "1"
        yield f"sinh({n}*x + y)", "sinh(y)"
        yield f"(x + y)**{n}", "1"
        yield f"x**(-{n})", "1"
        yield f"a**({n}/2)", "1"
    for n in (110881, 110880, 55440, 10**6 + 3, P, P + 1, *ANGLES):
        yield f"sin(x + 2*pi/{n})", "sin(x)"
        yield f"cos(2*pi/{n})", "1"
        yield f"sin(x/{n})", "0"
        yield f"cos(x/{n})", "1"


def plain_numbers_modulo_the_primes() -> Iterator[Pair]:
    for n in (P, Q, P * Q, -P * Q, 2 * P * Q, (P * Q) ** 2, P * Q * 10**40, 2**62, 2**64, 2**128):
        yield f"{n}", "0"
        yield f"{n + 1}", "1"
        yield f"{n + 1} - 1", "0"
        yield f"{n}*{n}", "0"
        yield f"1/{abs(n) + 1}", "1"
        yield f"5/{n}", "0"
        yield f"{n}/3", "0"
    yield f"1/{P}", f"1/{Q}"
    yield f"{P * Q - 1}*{P * Q - 1}", "1"
    yield f"{P}/{P + 1}", "0"


def coefficients_modulo_the_primes() -> Iterator[Pair]:
    for n in (P, Q, -P, 2 * P, P * 1000, 2**61 - 1, 2**62, 2**64, 2**79):
        yield f"{n}*x", "0"
        yield f"x + {n}", "x"
        yield f"{n + 1}*x**2", "x**2"
        yield f"x/{abs(n) + 1}", "x"
        yield f"sin(x + {n})", "sin(x)"
        yield f"sin({n + 1}*x)", "sin(x)"
        yield f"exp({n}*x)", "1"
        yield f"exp({n})", "1"
        yield f"x**{abs(n)}", "1"
        yield f"x**{abs(n) + 1}", "x"
        yield f"sqrt(x + {n})", "sqrt(x)"
        yield f"sqrt({abs(n) + 2})", "sqrt(2)"
        yield f"f(x + {n})", "f(x)"
        yield f"f({n})", "f(0)"
        yield f"abs(x + {n})", "abs(x)"
        yield f"atan2(y, x + {n})", "atan2(y, x)"
        yield f"log({abs(n) + 3})", "log(3)"
        yield f"{n}*sin(x) + cos(x)", "cos(x)"
    yield f"x/{P}", "0"
    yield f"{P}*x + {Q}*y", "0"
    yield f"x/(y + {P})", "x/y"
    yield f"1/(x - {Q})", "1/x"


def numbers() -> Iterator[Pair]:
    yield "0.1 + 0.2", "0.30000000000000004"
    yield "0.1 + 0.2", "0.3000000000000001"
    yield "0.3", "0.30000000000000004"
    yield "0.1*0.1", "0.010000000000000002"
    yield "0.1*3", "0.30000000000000004"
    yield "1/3", "0.3333333333333333"
    yield "2/3", "0.6666666666666666"
    yield "1/3 + 1/3", "0.6666666666666666"
    yield "sqrt(2)", "1.4142135623730951"
    yield "sqrt(2)/2", "0.7071067811865476"
    yield "0.7071067811865476**2", "1/2"
    yield "pi", "3.141592653589793"
    yield "pi", "355/113"
    yield "pi**2", "10"
    yield "pi", "sqrt(10)"
    yield "exp(1)", "2.718281828459045"
    yield "sin(3.141592653589793)", "0"
    yield "cos(1.5707963267948966)", "0"
    yield "sin(pi/4)", "0.7071067811865476"
    yield "cos(pi/3 + 1e-17)", "1/2"
    yield "x + 1e-300", "x"
    yield "1 + 1e-17", "1"
    yield "x*(1 + 1e-200)", "x"
    yield "1e308*10", "1e308"
    yield "1e16 + 1", "1e16"
    yield "9007199254740993", "9007199254740992.0"
    yield "exp(pi*sqrt(163))", "262537412640768744"
    yield "sqrt(2) + sqrt(3)", "pi"
    yield "sqrt(10) + sqrt(11)", "sqrt(5) + sqrt(18)"
    yield "sqrt(2) + sqrt(3)", "sqrt(5)"
    yield "sqrt(2) + sqrt(3)", "sqrt(10)"
    yield "sqrt(2)*sqrt(37)", "sqrt(73)"
    yield "(1 + sqrt(5))/2", "1.618033988749895"
    yield "sin(1)**2 + cos(2)**2", "1"
    yield "sin(1)", "sin(2)/2"
    yield "log(2)", "0.6931471805599453"
    for k in range(1, 30):
        yield f"{k}/{k + 1}", f"{k + 1}/{k + 2}"
    for m, n in pairwise((2, 3, 5, 6, 7, 8, 10, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 1009)):
        yield f"sqrt({m})", f"-sqrt({m})"
        yield f"sqrt({m})", f"sqrt({n})"
        yield f"sqrt({m})*sqrt({n})", f"-sqrt({m * n})"
        yield f"sqrt({m}) + sqrt({n})", f"sqrt({m + n})"
        yield f"x*sqrt({m})", "x"


def algebraic_values_with_wrong_signs() -> Iterator[Pair]:
    yield "4*cos(pi/5) - 1", "-sqrt(5)"
    yield "4*cos(3*pi/5) - 1", "sqrt(5)"
    yield "2*cos(pi/4)", "-sqrt(2)"
    yield "2*cos(3*pi/4)", "sqrt(2)"
    yield "2*cos(5*pi/6)", "sqrt(3)"
    yield "2*sin(pi/3)", "-sqrt(3)"
    yield "tan(pi/7)*tan(2*pi/7)*tan(3*pi/7)", "-sqrt(7)"
    yield "tan(3*pi/11) + 4*sin(2*pi/11)", "-sqrt(11)"
    yield "tan(pi/8)", "-1 - sqrt(2)"
    yield "tan(pi/12)", "2 + sqrt(3)"
    yield "sin(pi/12)", "(sqrt(6) + sqrt(2))/4"
    yield "cos(pi/12)", "(sqrt(6) - sqrt(2))/4"
    yield "sin(pi/10)", "(sqrt(5) + 1)/4"
    for prime, wave in (
        (3, "sin"),
        (5, "cos"),
        (7, "sin"),
        (11, "sin"),
        (13, "cos"),
        (17, "cos"),
        (19, "sin"),
        (23, "sin"),
        (29, "cos"),
        (31, "sin"),
    ):
        squares = {k * k % prime for k in range(1, prime)}
        signs = ((k, "+" if k in squares else "-") for k in range(1, prime))
        yield "".join(f" {sign} {wave}(2*{k}*pi/{prime})" for k, sign in signs), f"-sqrt({prime})"
    for k in range(1, 60):
        yield f"sin({k}*pi/60)", f"sin({k + 60}*pi/60)"
        if k != 30:
            yield f"cos({k}*pi/60)", f"cos({60 - k}*pi/60)"
        if k != 15:
            yield f"sin({k}*pi/60)", f"cos({k}*pi/60)"


def signs_and_names() -> Iterator[Pair]:
    yield "x", "-x"
    yield "x", "y"
    yield "x - y", "y - x"
    yield "x", "a"
    yield "x0", "x1"
    yield "x1", "x2"
    yield "x0*x2", "x1**2"
    yield "x0", "x"
    yield "f(x)", "f(y)"
    yield "f(x)", "h(x)"
    yield "f(x, y)", "f(y, x)"
    yield "f(x, y)", "f(x)"
    yield "f(x)", "x"
    yield "f(x + y)", "f(x) + f(y)"
    yield "f(2*x)", "2*f(x)"
    yield "f(-x)", "-f(x)"
    yield "f(f(x))", "f(x)"
    yield "D(f(x), x)", "f(x)"
    yield "D(f(x), x)", "D(h(x), x)"
    yield "D(D(f(x), x), x)", "D(f(x), x)"
    yield "D(f(x, y), x)", "D(f(x, y), y)"
    yield "D(f(2*x), x)", "D(f(x), x)"
    yield "sin(x)", "-sin(-x) + 2*sin(-x)"
    yield "sin(x + y)", "sin(x) + sin(y)"
    yield "sin(x)*cos(y)", "cos(x)*sin(y)"
    yield "cos(x - y)", "cos(x)*cos(y) - sin(x)*sin(y)"
    yield "cos(x)**2 - sin(x)**2", "1"
    yield "cos(2*x)", "2*cos(x)**2"
    yield "sin(x**2)", "sin(x)**2"
    yield "sin(x*y)", "sin(x)*sin(y)"
    yield "sin(x)", "sinh(x)"
    yield "cos(x)", "cosh(x)"
    yield "cosh(x)**2 + sinh(x)**2", "1"
    yield "tan(x)", "tanh(x)"
    yield "sin(x + pi)", "sin(x)"
    yield "sin(x + 1)", "sin(x)"
    yield "sin(x + 6)", "sin(x)"
    yield "tan(x + pi/2)", "tan(x)"
    yield "sin(x*pi)", "0"
    yield "sin(pi*x)", "sin(pi*y)"
    yield "sin(pi**2)", "0"
    yield "sin(pi*sqrt(2))", "0"
    yield "(x + y)**2", "x**2 + y**2"
    yield "(x + y)**2", "x**2 + x*y + y**2"
    yield "1/(x + y)", "1/x + 1/y"
    yield "x/(y/z)", "x/y/z"
    yield "x**y", "y**x"
    yield "2**x", "x**2"
    yield "x**(1/2)", "x**(1/3)"
    yield "a**x", "b**x"


FAMILIES = (
    branches,
    inverses,
    multiples_off_by_one,
    angles_modulo_the_circle,
    plain_numbers_modulo_the_primes,
    coefficients_modulo_the_primes,
    numbers,
    algebraic_values_with_wrong_signs,
    signs_and_names,
)
