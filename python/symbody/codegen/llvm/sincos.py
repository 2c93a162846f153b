"""Sine and cosine in LLVM's intermediate representation, for one angle or several at a time.

The angle is reduced by a multiple of pi/2 in three parts with fused multiplications [Cody & Waite 1980]; polynomials of
[Ng 1993, fdlibm] give sine and cosine on [-pi/4, pi/4], and the quadrant chooses and signs them. Angles beyond
:data:`LARGEST`, infinite ones and NaN go to the system's functions.

The sine of -0.0 is 0.0, not -0.0: to keep that sign takes a tenth of a nanosecond an angle, 3 % of an arm's inverse
dynamics in vectors, and shows nowhere but in 1/sin and in atan2 on its branch cut.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

from symbody.codegen.llvm.writer import constants, vector_type

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


@cache
def sincos_text(lanes: int) -> str:
    """Return the functions of a module that take sine and cosine of so many angles.

    ``@sincos_<lanes>`` does so for angles up to :data:`LARGEST`, ``@is_large_<lanes>`` returns whether one of them is
    larger or NaN, and ``@system_sincos_<lanes>`` serves all: an angle has the same sine, whatever is beside it.
    """
    V, pair = _types(lanes)
    return f"""\
define internal {pair} @sincos_{lanes}({V} %x) alwaysinline {{
{_fast_text(lanes)}
{_returned(lanes, "%signed_sine", "%signed_cosine")}
}}

define internal i1 @is_large_{lanes}({V} %x) alwaysinline {{
{_is_large(lanes)}
}}

{_system_text(lanes)}"""


def _types(lanes: int) -> tuple[str, str]:
    """Return the type of so many doubles, and that of two such vectors."""
    V = vector_type(lanes)
    return V, f"{{ {V}, {V} }}"


@cache
def checked_text(lanes: int) -> str:
    """Return ``@checked_sincos_<lanes>``, which serves all angles by the functions of `sincos_text`."""
    V, both = _types(lanes)
    result = f"ret {both}"
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


def _returned(lanes: int, sine: str, cosine: str) -> str:
    """Return the lines that return both."""
    V, pair = _types(lanes)
    return f"""\
  %first = insertvalue {pair} poison, {V} {sine}, 0
  %both = insertvalue {pair} %first, {V} {cosine}, 1
  ret {pair} %both"""


def _fast_text(lanes: int) -> str:
    """Return the lines that make ``%signed_sine`` and ``%signed_cosine`` of ``%x``, a small angle."""
    V, bits, mask = vector_type(lanes), vector_type(lanes, "i64"), vector_type(lanes, "i1")
    two_over_pi, magic, minus_half, one = constants([0.6366197723675814, _ROUND, -0.5, 1.0], lanes)
    high, middle, low = constants([-part for part in _HALF_PI], lanes)
    zero_bits, one_bit, two_bits, shift = _integers((0, 1, 2, 62), lanes)
    fma = _fma(lanes)
    return f"""\
  %shifted = {fma("%x", two_over_pi, magic)}
  %multiple = fsub {V} %shifted, {magic}
  %quadrant = bitcast {V} %shifted to {bits}
  %reduced1 = {fma("%multiple", high, "%x")}
  %reduced2 = {fma("%multiple", middle, "%reduced1")}
  %r = {fma("%multiple", low, "%reduced2")}
  %z = fmul {V} %r, %r
  %zr = fmul {V} %z, %r
{_horner(lanes, "%s", _SINE)}
  %sine = {fma("%zr", "%s0", "%r")}
{_horner(lanes, "%c", _COSINE)}
  %c = {fma("%z", "%c0", minus_half)}
  %cosine = {fma("%z", "%c", one)}
  %odd_bit = and {bits} %quadrant, {one_bit}
  %odd = icmp ne {bits} %odd_bit, {zero_bits}
  %plain_sine = select {mask} %odd, {V} %cosine, {V} %sine
  %plain_cosine = select {mask} %odd, {V} %sine, {V} %cosine
  %next_quadrant = add {bits} %quadrant, {one_bit}
  %sine_bit = and {bits} %quadrant, {two_bits}
  %sine_sign = shl {bits} %sine_bit, {shift}
  %sine_raw = bitcast {V} %plain_sine to {bits}
  %sine_flipped = xor {bits} %sine_raw, %sine_sign
  %signed_sine = bitcast {bits} %sine_flipped to {V}
  %cosine_bit = and {bits} %next_quadrant, {two_bits}
  %cosine_sign = shl {bits} %cosine_bit, {shift}
  %cosine_raw = bitcast {V} %plain_cosine to {bits}
  %cosine_flipped = xor {bits} %cosine_raw, %cosine_sign
  %signed_cosine = bitcast {bits} %cosine_flipped to {V}"""


def _fma(lanes: int) -> Callable[[str, str, str], str]:
    """Return what writes ``a b + c``, rounded once."""
    V, suffix = vector_type(lanes), "f64" if lanes == 1 else f"v{lanes}f64"
    return lambda a, b, c: f"call {V} @llvm.fma.{suffix}({V} {a}, {V} {b}, {V} {c})"


def _integers(values: Sequence[int], lanes: int) -> list[str]:
    """Return integers, each in all lanes."""
    return [str(v) if lanes == 1 else f"<{', '.join([f'i64 {v}'] * lanes)}>" for v in values]


def _horner(lanes: int, name: str, coefficients: Sequence[float]) -> str:
    """Return the lines that make ``{name}0``, the polynomial of these coefficients at ``%z``."""
    *others, value = constants(coefficients, lanes)
    fma, lines = _fma(lanes), []
    for power, coefficient in reversed(list(enumerate(others))):
        lines.append(f"  {name}{power} = {fma(value, '%z', coefficient)}")
        value = f"{name}{power}"
    return "\n".join(lines)


def _is_large(lanes: int) -> str:
    if lanes == 1:
        return "\n".join([_beyond(lanes), "  ret i1 %beyond"])
    reduced = f"  %large = call i1 @llvm.vector.reduce.or.v{lanes}i1(<{lanes} x i1> %beyond)"
    return "\n".join([_beyond(lanes), reduced, "  ret i1 %large"])


def _beyond(lanes: int) -> str:
    """Return the lines that make ``%beyond``: where ``%x`` is large or NaN."""
    V, suffix = vector_type(lanes), "f64" if lanes == 1 else f"v{lanes}f64"
    (largest,) = constants([LARGEST], lanes)
    return f"""\
  %size = call {V} @llvm.fabs.{suffix}({V} %x)
  %beyond = fcmp ugt {V} %size, {largest}"""


def _system_text(lanes: int) -> str:
    """Return the function that takes sine and cosine of large angles from the system."""
    (V, pair), mask, lines = _types(lanes), vector_type(lanes, "i1"), [_beyond(lanes)]
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
    lines += [
        f"  %ours = call {pair} @sincos_{lanes}({V} %x)",
        f"  %our_sine = extractvalue {pair} %ours, 0",
        f"  %our_cosine = extractvalue {pair} %ours, 1",
        f"  %chosen_sine = select {mask} %beyond, {V} {sine}, {V} %our_sine",
        f"  %chosen_cosine = select {mask} %beyond, {V} {cosine}, {V} %our_cosine",
    ]
    body = "\n".join([*lines, _returned(lanes, "%chosen_sine", "%chosen_cosine")])
    return f"define internal {pair} @system_sincos_{lanes}({V} %x) noinline cold {{\n{body}\n}}\n"
