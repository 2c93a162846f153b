"""Sine and cosine in LLVM's intermediate representation, for one angle or several at a time.

The angle is reduced by a multiple of pi/2 in three parts with fused multiplications [Cody & Waite 1980]; polynomials of
[Ng 1993, fdlibm] give sine and cosine on [-pi/4, pi/4], and the quadrant chooses and signs them. Angles beyond
:data:`LARGEST`, infinite ones and those that are no numbers go to the system's functions.
"""

from __future__ import annotations

from symbody.codegen.vector import constant, vector_type

__all__ = ["LARGEST", "sincos_text"]

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

    ``@sincos<lanes>`` does so for angles up to :data:`LARGEST`, ``@is_large<lanes>`` tells whether one of them is
    beyond or is no number, and ``@system_sincos<lanes>`` serves all.
    """
    body = _Writer(lanes)
    n, bits = _quadrant(body)
    sine, cosine = _in_quadrant(body, bits, *_polynomials(body, _reduced(body, n)))
    V = vector_type(lanes)
    return f"""\
define internal {{ {V}, {V} }} @sincos{lanes}({V} %x) alwaysinline {{
{body.text}
{_pair(V, sine, cosine)}
}}

define internal i1 @is_large{lanes}({V} %x) alwaysinline {{
{_is_large(lanes)}
}}

{_system_text(lanes)}"""


def _pair(V: str, sine: str, cosine: str) -> str:
    return f"""\
  %first = insertvalue {{ {V}, {V} }} poison, {V} {sine}, 0
  %both = insertvalue {{ {V}, {V} }} %first, {V} {cosine}, 1
  ret {{ {V}, {V} }} %both"""


class _Writer:
    """Lines of a function of vectors."""

    def __init__(self, lanes: int) -> None:
        self.lanes, self.lines = lanes, list[str]()
        self.V, self.I = vector_type(lanes), vector_type(lanes, "i64")
        self.suffix = "f64" if lanes == 1 else f"v{lanes}f64"

    @property
    def text(self) -> str:
        return "\n".join(self.lines)

    def let(self, instruction: str) -> str:
        name = f"%t{len(self.lines)}"
        self.lines.append(f"  {name} = {instruction}")
        return name

    def number(self, value: float) -> str:
        return constant(value, self.lanes)

    def integer(self, value: int) -> str:
        return str(value) if self.lanes == 1 else f"<{', '.join([f'i64 {value}'] * self.lanes)}>"

    def fma(self, a: str, b: str, c: str) -> str:
        return self.let(f"call {self.V} @llvm.fma.{self.suffix}({self.V} {a}, {self.V} {b}, {self.V} {c})")

    def call(self, operation: str, a: str, b: str) -> str:
        return self.let(f"{operation} {self.V} {a}, {b}")


def _quadrant(w: _Writer) -> tuple[str, str]:
    """Return the nearest multiple of pi/2, and bits the two lowest of which are its quadrant."""
    shifted = w.fma("%x", w.number(0.6366197723675814), w.number(_ROUND))
    return w.call("fsub", shifted, w.number(_ROUND)), w.let(f"bitcast {w.V} {shifted} to {w.I}")


def _reduced(w: _Writer, n: str) -> str:
    r = "%x"
    for part in _HALF_PI:
        r = w.fma(n, w.number(-part), r)
    return r


def _polynomials(w: _Writer, r: str) -> tuple[str, str]:
    z = w.call("fmul", r, r)
    sine = w.fma(w.call("fmul", z, r), _horner(w, z, _SINE), r)
    half = w.call("fmul", z, w.number(0.5))
    top = w.call("fsub", w.number(1.0), half)
    rest = w.call("fsub", w.call("fsub", w.number(1.0), top), half)
    cosine = w.call("fadd", top, w.fma(w.call("fmul", z, z), _horner(w, z, _COSINE), rest))
    return sine, cosine


def _horner(w: _Writer, z: str, coefficients: tuple[float, ...]) -> str:
    value = w.number(coefficients[-1])
    for coefficient in reversed(coefficients[:-1]):
        value = w.fma(value, z, w.number(coefficient))
    return value


def _in_quadrant(w: _Writer, bits: str, sine: str, cosine: str) -> tuple[str, str]:
    """Return sine and cosine: exchanged in odd quadrants, with the signs of the quadrant."""
    odd_bit = w.let(f"and {w.I} {bits}, {w.integer(1)}")
    mask = vector_type(w.lanes, "i1")
    odd = w.let(f"icmp ne {w.I} {odd_bit}, {w.integer(0)}")
    first = w.let(f"select {mask} {odd}, {w.V} {cosine}, {w.V} {sine}")
    second = w.let(f"select {mask} {odd}, {w.V} {sine}, {w.V} {cosine}")
    next_quadrant = w.let(f"add {w.I} {bits}, {w.integer(1)}")
    return _signed(w, first, bits), _signed(w, second, next_quadrant)


def _signed(w: _Writer, value: str, quadrant: str) -> str:
    """Return the value with the opposite sign in the quadrants 2 and 3."""
    bit = w.let(f"and {w.I} {quadrant}, {w.integer(2)}")
    sign = w.let(f"shl {w.I} {bit}, {w.integer(62)}")
    raw = w.let(f"bitcast {w.V} {value} to {w.I}")
    flipped = w.let(f"xor {w.I} {raw}, {sign}")
    return w.let(f"bitcast {w.I} {flipped} to {w.V}")


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
    return f"define internal {{ {V}, {V} }} @system_sincos{lanes}({V} %x) noinline cold {{\n{body}\n}}\n"
