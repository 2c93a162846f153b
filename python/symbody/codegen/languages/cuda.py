"""CUDA C: functions that a thread of a graphics processor calls, and that compile as C++ as well."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from symbody.codegen.languages.c import C
from symbody.codegen.layout.code_text import part_lines, wrap_line
from symbody.codegen.layout.language import Language
from symbody.codegen.layout.module import Array, Function, Module
from symbody.codegen.runtime.linear_solve import kernel_text
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["LANGUAGE", "device_functions", "device_prelude"]

_OWN = """
sine cosine wave near UNROLL restrict DBL_MIN DBL_MAX DBL_EPSILON deficient threadIdx blockIdx blockDim gridDim
warpSize
"""

LANGUAGE: Language = replace(
    C.language,
    functions={
        **C.language.functions,
        Operation.SIN: "sine({})",
        Operation.COS: "cosine({})",
    },
    reserved=C.language.reserved | frozenset(_OWN.split()),
    factor="*deficient |= symbody_factor({n}, {work}) != 0;",
    fused="fma({}, {}, {})",
    qualified=False,
)
"""C with fused products, with sines and cosines of our own, and with a note of deficient linear systems."""

_OUTSIDE = "factor|solve|take_units|reflect_columns|find_directions|mark|solve_orthogonal"
"""The functions of linear systems that are not inlined: they would make most of the code."""

_PRELUDE = """\
#ifndef DBL_MIN
#define DBL_MIN 2.2250738585072014e-308
#define DBL_MAX 1.7976931348623157e308
#define DBL_EPSILON 2.220446049250313e-16
#endif
#ifndef INFINITY
#define INFINITY __longlong_as_double(0x7ff0000000000000LL)
#endif
#ifndef NAN
#define NAN __longlong_as_double(0x7ff8000000000000LL)
#endif
#define UNROLL _Pragma("unroll")

/* The sine of an angle up to 1e5, or, of the angle in the next quadrant, its cosine: the arithmetic of the machine
 * code for the host (codegen/llvm/sincos.py). Sine and cosine of one angle share its reduction. */
static __device__ __forceinline__ double wave(double x, long long next)
{
    const double shifted = fma(x, 0.6366197723675814, 6755399441055744.0);
    const double multiple = shifted - 6755399441055744.0;
    const long long quadrant = __double_as_longlong(shifted) + next;
    const double high = fma(multiple, -1.5707963267948966, x), middle = fma(multiple, -6.123233995736766e-17, high);
    const double r = fma(multiple, 1.4973849048591698e-33, middle), z = r*r;
    double s = 1.58969099521155010221e-10, c = -1.13596475577881948265e-11;
    s = fma(fma(s, z, -2.50507602534068634195e-08), z, 2.75573137070700676789e-06);
    s = fma(fma(fma(s, z, -1.98412698298579493134e-04), z, 8.33333333332248946124e-03), z, -1.66666666666666324348e-01);
    c = fma(fma(c, z, 2.08757232129817482790e-09), z, -2.75573143513906633035e-07);
    c = fma(fma(fma(c, z, 2.48015872894767294178e-05), z, -1.38888888888741095749e-03), z, 4.16666666666666019037e-02);
    const double sine = fma(z*r, s, r), cosine = fma(z, fma(z, c, -0.5), 1.0);
    const double value = quadrant & 1 ? cosine : sine;
    return quadrant & 2 ? -value : value;
}

static __device__ __forceinline__ double sine(double x) { return fabs(x) <= 1e5 ? wave(x, 0) : sin(x); }
static __device__ __forceinline__ double cosine(double x) { return fabs(x) <= 1e5 ? wave(x, 1) : cos(x); }
static __device__ __forceinline__ double sign_of(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x; }
static __device__ __forceinline__ double least(double a, double b) { return a < b || a != a ? a : b; }
static __device__ __forceinline__ double greatest(double a, double b) { return a > b || a != a ? a : b; }
"""


def device_prelude(module: Module) -> str:
    """Return what the functions of a module need before them."""
    if Operation.FACTOR not in module.operations:
        return _PRELUDE
    kernel = re.sub(r"^#include.*\n", "", kernel_text("linear_solve.c"), flags=re.MULTILINE)
    kernel = re.sub(r"^static ", "static __device__ ", kernel, flags=re.MULTILINE)
    kernel = re.sub(rf"__device__ (\w+) (?=symbody_({_OUTSIDE})\()", r"__device__ __noinline__ \1 ", kernel)
    return f"{_PRELUDE}\n#define restrict __restrict__\n{kernel}"


def device_functions(module: Module) -> str:
    """Return the functions of a module: arguments, then results, then a flag that a deficient linear system sets.

    A function is not inlined: it occurs in many places of a loop.
    """
    return "\n\n".join("\n".join(_function(function)) for function in module.functions)


def _function(function: Function) -> Sequence[str]:
    arrays = [f"    double {name}[{size}];" for name, size in function.arrays]
    calls = [line for call in function.calls for line in wrap_line(_call(call), LANGUAGE, "    ")]
    unused = [f"    (void){a.name};" for a in function.arguments if a.name not in function.mentions]
    (part,) = function.composition.parts
    title = wrap_line(_signature(function), LANGUAGE, "")
    body = part_lines(part, LANGUAGE, function.shapes)
    return [*title, "{", *arrays, *calls, *body, *unused, "    (void)deficient;", "}"]


def _signature(function: Function) -> str:
    parameters = [_parameter(a, "const ") for a in function.arguments]
    parameters += [_parameter(r, "") for r in function.results]
    return (
        f"static __device__ __noinline__ void {function.name}({', '.join([*parameters, 'int *deficient'])})"
    )


def _parameter(array: Array, constant: str) -> str:
    return f"double {array.name}" if array.is_scalar else f"{constant}double *__restrict__ {array.name}"


def _call(function: Function) -> str:
    names = [array.name for array in (*function.arguments, *function.results)]
    return f"{function.name}({', '.join([*names, 'deficient'])});"
