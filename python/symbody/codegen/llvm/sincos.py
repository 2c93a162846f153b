"""Sine and cosine in LLVM's intermediate representation, for one angle or several at a time.

The angle is reduced by a multiple of pi/2 in three parts with fused multiplications [Cody & Waite 1980]; polynomials of
[Ng 1993, fdlibm] give sine and cosine on [-pi/4, pi/4], and the quadrant chooses and signs them. Angles beyond
:data:`LARGEST`, infinite ones and those that are no numbers go to the system's functions.

The sine of -0.0 is 0.0, not -0.0: to keep that sign takes a tenth of a nanosecond an angle, 3 % of an arm's inverse
dynamics in vectors, and shows nowhere but in 1/sin and in atan2 on its branch cut.
"""

from __future__ import annotations

from symbody.codegen.llvm.vector import constant, vector_type
from symbody.codegen.llvm.writer import Writer

__all__ = ["LARGEST", "checked_text", "sincos_text"]

LARGEST = 1.0e5
"""The largest angle of the fast reduction: the multiple of pi/2 keeps its exact product with the first part."""

_ROUND = 6755399441055744.0
"""1.5 * 2**52: added, it leaves the nearest integer in the lowest bits."""

_HALF_PI = (1.5707963267948966, 6.123233995736766e-17, -1.4973849048591698e-33)
"""pi/2 in three doubles, each the nearest one to what the earlier ones leave."""

_SINE = (
    -1.66666666666666324348e-01, 8.33333333332248946124e-03, -1.98412698298579493134e-04,
    2.75573137070700676789e-06, -2.50507602534068634195e-08, 1.58969099521155010221e-10,
)  # fmt: skip
"""sin r = r + r^3 (s1 + s2 r^2 + ...)"""

_COSINE = (
    4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05,
    -2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11,
)  # fmt: skip
"""cos r = 1 - r^2/2 + r^4 (c1 + c2 r^2 + ...)"""


def sincos_text(lanes: int) -> str:
    """Return the functions of a module that take sine and cosine of so many angles.

    ``@sincos_<lanes>`` does so for angles up to :data:`LARGEST`, ``@is_large_<lanes>`` tells whether one of them is
    beyond or is no number, and ``@system_sincos_<lanes>`` serves all.
    """
    body = Writer(lanes)
    n, bits = _quadrant(body)
    sine, cosine = _in_quadrant(body, bits, *_polynomials(body, _reduced(body, n)))
    V, lines = vector_type(lanes), "\n".join(body.lines)
    return f"""\
define internal {{ {V}, {V} }} @sincos_{lanes}({V} %x) alwaysinline {{
{lines}
{_pair(V, sine, cosine)}
}}

define internal i1 @is_large_{lanes}({V} %x) alwaysinline {{
{_is_large(lanes)}
}}

{_system_text(lanes)}"""


def checked_text(lanes: int) -> str:
    """Return ``@checked_sincos_<lanes>``, which serves all angles by the functions of `sincos_text`."""
    V = vector_type(lanes)
    both, result = f"{{ {V}, {V} }}", f"ret {{ {V}, {V} }}"
    return f"""\
define internal {both} @checked_sincos_{lanes}({V} %x) noinline {{
  %large = call i1 @is_large_{lanes}({V} %x)
  br i1 %large, label %slow, label %fast, !prof !0
fast:
  %ours = call {both} @sincos_{lanes}({V} %x)
  {result} %ours
slow:
  %theirs = call {both} @system_sincos_{lanes}({V} %x)
  {result} %theirs
}}
"""


def _pair(V: str, sine: str, cosine: str) -> str:
    return f"""\
  %first = insertvalue {{ {V}, {V} }} poison, {V} {sine}, 0
  %both = insertvalue {{ {V}, {V} }} %first, {V} {cosine}, 1
  ret {{ {V}, {V} }} %both"""


def _fma(w: Writer, a: str, b: str, c: str) -> str:
    return w.intrinsic("fma", a, b, c)


def _call(w: Writer, operation: str, a: str, b: str) -> str:
    return w.let(f"{operation} {w.V} {a}, {b}")


def _integers(w: Writer) -> str:
    return vector_type(w.lanes, "i64")


def _integer(w: Writer, value: int) -> str:
    return str(value) if w.lanes == 1 else f"<{', '.join([f'i64 {value}'] * w.lanes)}>"


def _quadrant(w: Writer) -> tuple[str, str]:
    """Return the nearest multiple of pi/2, and bits the two lowest of which are its quadrant."""
    shifted = _fma(w, "%x", w.number(0.6366197723675814), w.number(_ROUND))
    return _call(w, "fsub", shifted, w.number(_ROUND)), w.let(f"bitcast {w.V} {shifted} to {_integers(w)}")


def _reduced(w: Writer, n: str) -> str:
    r = "%x"
    for part in _HALF_PI:
        r = _fma(w, n, w.number(-part), r)
    return r


def _polynomials(w: Writer, r: str) -> tuple[str, str]:
    z = _call(w, "fmul", r, r)
    sine = _fma(w, _call(w, "fmul", z, r), _horner(w, z, _SINE), r)
    cosine = _fma(w, z, _fma(w, z, _horner(w, z, _COSINE), w.number(-0.5)), w.number(1.0))
    return sine, cosine


def _horner(w: Writer, z: str, coefficients: tuple[float, ...]) -> str:
    value = w.number(coefficients[-1])
    for coefficient in reversed(coefficients[:-1]):
        value = _fma(w, value, z, w.number(coefficient))
    return value


def _in_quadrant(w: Writer, bits: str, sine: str, cosine: str) -> tuple[str, str]:
    """Return sine and cosine: exchanged in odd quadrants, with the signs of the quadrant."""
    odd_bit = w.let(f"and {_integers(w)} {bits}, {_integer(w, 1)}")
    mask = vector_type(w.lanes, "i1")
    odd = w.let(f"icmp ne {_integers(w)} {odd_bit}, {_integer(w, 0)}")
    first = w.let(f"select {mask} {odd}, {w.V} {cosine}, {w.V} {sine}")
    second = w.let(f"select {mask} {odd}, {w.V} {sine}, {w.V} {cosine}")
    next_quadrant = w.let(f"add {_integers(w)} {bits}, {_integer(w, 1)}")
    return _signed(w, first, bits), _signed(w, second, next_quadrant)


def _signed(w: Writer, value: str, quadrant: str) -> str:
    """Return the value with the opposite sign in the quadrants 2 and 3."""
    bit = w.let(f"and {_integers(w)} {quadrant}, {_integer(w, 2)}")
    sign = w.let(f"shl {_integers(w)} {bit}, {_integer(w, 62)}")
    raw = w.let(f"bitcast {w.V} {value} to {_integers(w)}")
    flipped = w.let(f"xor {_integers(w)} {raw}, {sign}")
    return w.let(f"bitcast {_integers(w)} {flipped} to {w.V}")


def _is_large(lanes: int) -> str:
    V, suffix = vector_type(lanes), "f64" if lanes == 1 else f"v{lanes}f64"
    lines = [
        f"  %size = call {V} @llvm.fabs.{suffix}({V} %x)",
        f"  %beyond = fcmp ugt {V} %size, {constant(LARGEST, lanes)}",
    ]
    if lanes == 1:
        return "\n".join([*lines, "  ret i1 %beyond"])
    reduced = f"  %large = call i1 @llvm.vector.reduce.or.v{lanes}i1(<{lanes} x i1> %beyond)"
    return "\n".join([*lines, reduced, "  ret i1 %large"])


def _system_text(lanes: int) -> str:
    """Return the function that takes sine and cosine of each lane from the system."""
    V, lines = vector_type(lanes), list[str]()
    sine, cosine = "poison", "poison"
    for k in range(lanes):
        x = "%x" if lanes == 1 else f"%x{k}"
        lines += [] if lanes == 1 else [f"  {x} = extractelement {V} %x, i32 {k}"]
        for name in ("sin", "cos"):
            lines += [f"  %{name}{k} = call double @{name}(double {x})"]
        if lanes == 1:
            sine, cosine = "%sin0", "%cos0"
            continue
        lines += [f"  %s{k} = insertelement {V} {sine}, double %sin{k}, i32 {k}"]
        lines += [f"  %c{k} = insertelement {V} {cosine}, double %cos{k}, i32 {k}"]
        sine, cosine = f"%s{k}", f"%c{k}"
    body = "\n".join([*lines, _pair(V, sine, cosine)])
    return f"define internal {{ {V}, {V} }} @system_sincos_{lanes}({V} %x) noinline cold {{\n{body}\n}}\n"
