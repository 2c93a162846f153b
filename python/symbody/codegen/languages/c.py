"""C99: a header, a source, a self-check and a Makefile."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.codegen.languages.heads import comparisons, head, head_of_function, mark
from symbody.codegen.languages.target import Target
from symbody.codegen.layout.code_text import part_lines, wrap_line, wrap_lines
from symbody.codegen.layout.language import Language, functions, number_text
from symbody.codegen.layout.module import Array, Function, Module
from symbody.codegen.runtime.linear_solve import kernel_text
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["C"]

_KEYWORDS = """
auto break case char const continue default do double else enum extern float for goto if inline int long
register alignas alignof bool catch class constexpr delete explicit export false friend mutable namespace new
nullptr operator private protected public static_assert template this thread_local throw true try typeid
typename typeof using virtual wchar_t and bitand bitor compl not or xor asm restrict return short signed sizeof
static struct switch typedef union unsigned void volatile while main errno NULL sin cos tan asin acos atan atan2
sinh cosh tanh exp log log2 log10 sqrt pow fabs floor ceil y0 y1 yn j0 j1 jn gamma lgamma tgamma erf erfc fmin
fmax fma div abs index signbit isnan isinf isfinite nan round trunc hypot sign_of least greatest compare
failures printf I
"""

_HEADERS = """
assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdalign stdarg stdatomic
stdbool stddef stdint stdio stdlib stdnoreturn string tgmath threads time uchar wchar wctype symbody
"""

LANGUAGE = Language(
    comment=("/*", "*/"),
    declare="const double {name} = {value};",
    assign="{place} = {value};",
    functions=functions(
        Abs="fabs({})",
        sign="sign_of({})",
        Min="least({}, {})",
        Max="greatest({}, {})",
        Power="pow({}, {})",
        select="({} > 0.0 ? {} : {})",
    ),
    reserved=frozenset(_KEYWORDS.split()),
    reserved_programs=frozenset([*_KEYWORDS.split(), *_HEADERS.split()]),
    literal=lambda value: {"inf": "INFINITY", "-inf": "-INFINITY", "nan": "NAN"}.get(
        repr(value), number_text(value)
    ),
    scalar="*{}",
    qualified=True,
    clear="for (int i = 0; i < {size}; ++i) {array}[i] = 0.0;",
    factor="symbody_factor({n}, {work});",
    solve="symbody_solve({n}, {work}, {x});",
)

_HELPERS = {
    Operation.SIGN: "static double sign_of(double x) { return (x > 0.0) - (x < 0.0); }",
    Operation.MIN: "static double least(double a, double b) { return a < b || a != a ? a : b; }",
    Operation.MAX: "static double greatest(double a, double b) { return a > b || a != a ? a : b; }",
}


def _files(module: Module) -> dict[str, str]:
    return {
        f"{module.name}.h": _header(module),
        f"{module.name}.c": _source(module),
        f"{module.name}_check.c": _check(module),
        "Makefile": _makefile(module),
    }


def _comment(lines: Sequence[str]) -> list[str]:
    """Return lines as one comment, which nothing inside them ends."""
    lines = [line.replace("*/", "* /") for line in lines]
    starred = [f" * {line}".rstrip() for line in lines[1:]]
    return [f"/* {lines[0]}{'' if starred else ' */'}", *starred, *([" */"] if starred else [])]


def _parameter(array: Array, *, is_result: bool) -> str:
    constant = "" if is_result else "const "
    if array.is_scalar:
        return f"double *{array.name}" if is_result else f"{constant}double {array.name}"
    return f"{constant}double {array.name}[{array.size}]"


def _signature(module: Module, function: Function) -> str:
    parameters = [_parameter(a, is_result=False) for a in function.arguments]
    parameters += [_parameter(r, is_result=True) for r in function.results]
    return f"void {module.name}_{function.name}({', '.join(parameters)})"


def _header(module: Module) -> str:
    guard = f"{module.name.upper()}_H"
    title = "Functions of the model; results come last. Matrices are stored row by row."
    lines = [*_comment(head(module, title, 0)), f"#ifndef {guard}", f"#define {guard}", ""]
    lines += ["#ifdef __cplusplus", 'extern "C" {', "#endif"]
    for function in module.functions:
        lines += ["", *_comment(head_of_function(function))]
        lines += wrap_line(f"{_signature(module, function)};", LANGUAGE, "")
    lines += ["", "#ifdef __cplusplus", "}", "#endif", "", "#endif"]
    return "\n".join(lines) + "\n"


def _source(module: Module) -> str:
    lines = [*_comment([mark(module)]), f'#include "{module.name}.h"', "", "#include <math.h>"]
    helpers = [text for name, text in _HELPERS.items() if name in module.operations]
    lines += ["", *helpers] if helpers else []
    if Operation.FACTOR in module.operations:
        lines += ["", kernel_text("linear_solve.c").rstrip()]
    for function in module.functions:
        lines += ["", *_function(module, function)]
    return "\n".join(lines) + "\n"


def _function(module: Module, function: Function) -> list[str]:
    parts = function.composition.parts
    arrays = [f"    double {name}[{size}];" for name, size in function.arrays]
    calls = wrap_lines([_call_of(module, call) for call in function.calls], LANGUAGE, "    ")
    unused = [f"    (void){a.name};" for a in function.arguments if a.name not in function.mentions]
    if len(parts) == 1:
        definitions, body = [], part_lines(parts[0], LANGUAGE, function.shapes)
    else:
        definitions = [line for k in range(len(parts)) for line in [*_part(function, k), ""]]
        body = wrap_lines([_call(function, k) for k in range(len(parts))], LANGUAGE, "    ")
    title = wrap_line(_signature(module, function), LANGUAGE, "")
    return [*definitions, *title, "{", *arrays, *calls, *body, *unused, "}"]


def _part(function: Function, number: int) -> list[str]:
    """Return one part as a function of the arrays that it uses."""
    part = function.composition.parts[number]
    parameters = {a.name: _parameter(a, is_result=False) for a in function.arguments}
    parameters |= {a.name: _parameter(a, is_result=True) for a in function.results}
    parameters |= {name: f"double {name}[{size}]" for name, size in function.arrays}
    listed = ", ".join(text for name, text in parameters.items() if name in part.mentions)
    title = f"static void {function.name}_part{number + 1}({listed})"
    return [*wrap_line(title, LANGUAGE, ""), "{", *part_lines(part, LANGUAGE, function.shapes), "}"]


def _call(function: Function, number: int) -> str:
    mentioned = function.composition.parts[number].mentions
    names = [array.name for array in (*function.arguments, *function.results)]
    names += [name for name, _ in function.arrays]
    return f"{function.name}_part{number + 1}({', '.join(name for name in names if name in mentioned)});"


_COMPARE = """
static int failures = 0;

/* Compare an array with its reference, relative to the largest entry; zeros may differ by rounding. */
static void compare(const char *what, int n, const double *value, const double *reference)
{
    double largest = 0.0, error = 0.0;
    int i, same = 1;
    for (i = 0; i < n; ++i)
        if (fabs(reference[i]) > largest) largest = fabs(reference[i]);
    for (i = 0; i < n; ++i) {
        const double difference = fabs(value[i] - reference[i]);
        if (!(difference <= 1e-12*largest + 1e-15)) same = 0;
        if (!(difference <= error)) error = difference;
    }
    failures += !same;
    printf("  %-44s %5d %10.1e  %s\\n", what, n, largest > 0.0 ? error/largest : error, same ? "ok" : "DIFFERS");
}
"""


def _check(module: Module) -> str:
    title = [mark(module), "", "Evaluates every routine at one state and compares with reference values."]
    lines = [*_comment(title), f'#include "{module.name}.h"', "", "#include <math.h>", "#include <stdio.h>"]
    lines += [*_COMPARE.rstrip().splitlines(), "", "int main(void)", "{"]
    lines += wrap_lines(_values(module), LANGUAGE, "    ")
    if module.prepare:
        lines += [f"    double {r.name}[{r.size}];" for r in module.prepare.results]
    lines += ["", f'    printf("{module.name}: entries, largest relative error\\n");']
    lines += [f"    {_call_of(module, module.prepare)}"] if module.prepare else []
    for function, references in zip(module.routines, module.references, strict=True):
        lines += ["", *_comparison(module, function, references)]
    lines += ["", "    return failures > 0;", "}"]
    return "\n".join(lines) + "\n"


def _values(module: Module) -> list[str]:
    """Return the lines that give the arguments their values."""
    scalars = {array.name for array in module.arguments if array.is_scalar}
    literals = {name: ", ".join(map(LANGUAGE.literal, values)) for name, values in module.values.items()}
    return [
        f"const double {name} = {text};" if name in scalars else f"const double {name}[] = {{{text}}};"
        for name, text in literals.items()
    ]


def _comparison(module: Module, function: Function, references: Sequence[Sequence[float]]) -> list[str]:
    """Return a block that calls a routine and compares its results."""
    pairs = comparisons(function, references)
    body = [
        f"const double {result.name}_reference[] = {{{', '.join(map(LANGUAGE.literal, reference))}}};"
        for result, reference in pairs
    ]
    body.append(_call_of(module, function))
    body += [
        f'compare("{function.name}: {result.name}", {result.size}, {result.name}, {result.name}_reference);'
        for result, _ in pairs
    ]
    declared = [f"    double {result.name}[{result.size}];" for result in function.results]
    return [f"    {line}" for line in ["{", *declared, *wrap_lines(body, LANGUAGE, "    "), "}"]]


def _call_of(module: Module, function: Function) -> str:
    names = ", ".join(array.name for array in (*function.arguments, *function.results))
    return f"{module.name}_{function.name}({names});"


def _makefile(module: Module) -> str:
    name = module.name
    return f"""\
# {mark(module)}
# make: compile; make check: compile and compare with the reference values.
# -O2 takes half as long again to compile straight-line code, and makes it no faster.

CC     ?= cc
CFLAGS ?= -std=c99 -O1 -Wall -Wextra -pedantic

all: {name}.o

{name}.o: {name}.c {name}.h
\t$(CC) $(CFLAGS) -c {name}.c -o $@

{name}_check: {name}_check.c {name}.o {name}.h
\t$(CC) $(CFLAGS) {name}_check.c {name}.o -lm -o $@

check: {name}_check
\t./{name}_check

clean:
\trm -f {name}.o {name}_check

.PHONY: all check clean
"""


C = Target(
    name="c",
    title="C99",
    language=LANGUAGE,
    files=_files,
    check=("make check",),
    tools=("cc",),
)
