"""Fortran 2008: a module, a self-check and a Makefile."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody.codegen.languages.heads import (
    comment_lines,
    comparisons,
    head,
    head_of_function,
    in_rows,
    mark,
)
from symbody.codegen.languages.target import Target
from symbody.codegen.layout.code_text import part_lines, wrap_line, wrap_lines
from symbody.codegen.layout.language import Language, functions, number_text
from symbody.codegen.layout.module import Array, Function, Module
from symbody.codegen.runtime.linear_solve import kernel_text
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["FORTRAN"]

# Fortran reserves no words; these are the names that the generated code itself uses.
_NAMES = """
dp real64 iso_fortran_env abs acos asin atan atan2 cos cosh exp log max maxval merge min reshape sign sin sinh size
sqrt tan tanh transpose real integer sign_of least greatest compare failures reference symbody_factor symbody_solve
iso_c_binding ieee_arithmetic ieee_exceptions ieee_features omp_lib openacc mpi mpi_f08
"""

LANGUAGE = Language(
    comment=("!", ""),
    declare="{name} = {value}",
    assign="{place} = {value}",
    functions=functions(
        Abs="abs({})",
        sign="sign_of({})",
        Min="least({}, {})",
        Max="greatest({}, {})",
        Power="(({})**({}))",
        select="merge({1}, {2}, {0} > 0.0_dp)",
    ),
    reserved=frozenset(_NAMES.split()),
    literal=lambda value: f"{number_text(value)}_dp",
    entry="{}({})",
    matrix="{}({}, {})",
    first_index=1,
    clear="{array} = 0.0_dp",
    factor="call symbody_factor({n}, {work})",
    solve="call symbody_solve({n}, {work}, {x})",
    case_sensitive=False,
    continuation=" &",
)

_HELPERS = {
    Operation.SIGN: """
pure real(dp) function sign_of(x)
    real(dp), intent(in) :: x
    sign_of = merge(1.0_dp, 0.0_dp, x > 0.0_dp) - merge(1.0_dp, 0.0_dp, x < 0.0_dp)
end function sign_of
""",
    Operation.MIN: """
pure real(dp) function least(a, b)
    real(dp), intent(in) :: a, b
    least = merge(a, b, a < b .or. a /= a)
end function least
""",
    Operation.MAX: """
pure real(dp) function greatest(a, b)
    real(dp), intent(in) :: a, b
    greatest = merge(a, b, a > b .or. a /= a)
end function greatest
""",
}


def _files(module: Module) -> dict[str, str]:
    return {
        f"{module.name}.f90": _source(module),
        f"{module.name}_check.f90": _check(module),
        "Makefile": _makefile(module),
    }


def _source(module: Module) -> str:
    title = "Subroutines of the model; results come last."
    lines = [*comment_lines(head(module, title, 1), "!"), f"module {module.name}"]
    lines += ["    use, intrinsic :: iso_fortran_env, only: dp => real64", "    implicit none", "    private"]
    public = ", ".join(function.name for function in module.functions)
    lines += [*wrap_line(f"public :: {public}", LANGUAGE, "    "), "", "contains"]
    for function in module.functions:
        lines += _indented(["", *_subroutine(function)])
    helpers = [text for name, text in _HELPERS.items() if name in module.operations]
    if Operation.FACTOR in module.operations:
        helpers.append(kernel_text("linear_solve.f90"))
    for text in helpers:
        lines += _indented(["", *text.strip().splitlines()])
    return "\n".join([*lines, "", f"end module {module.name}"]) + "\n"


def _indented(lines: Iterable[str]) -> list[str]:
    return [f"    {line}".rstrip() for line in lines]


def _declared(array: Array, intent: str) -> str:
    shape = f"({', '.join(map(str, array.shape))})" if array.shape else ""
    return f"real(dp), intent({intent}) :: {array.name}{shape}"


def _subroutine(function: Function) -> list[str]:
    """Return a subroutine; if it is long, one that calls its parts, and these."""
    comments = comment_lines(head_of_function(function), "!")
    declared = {a.name: _declared(a, "in") for a in function.arguments}
    declared |= {r.name: _declared(r, "out") for r in function.results}
    working = [f"real(dp) :: {name}({size})" for name, size in function.arrays]
    called = wrap_lines([_call_of(call) for call in function.calls], LANGUAGE, "")
    parts = function.composition.parts
    if len(parts) == 1:
        body = [
            *_locals(parts[0].locals),
            "",
            *called,
            *part_lines(parts[0], LANGUAGE, function.shapes, ""),
        ]
        return [*comments, *_procedure(function.name, declared, [*working, *body])]
    calls = wrap_lines([_call(function, number) for number in range(len(parts))], LANGUAGE, "")
    definitions = [line for number in range(len(parts)) for line in ["", *_part(function, number)]]
    return [*comments, *_procedure(function.name, declared, [*working, "", *called, *calls]), *definitions]


def _procedure(name: str, declared: dict[str, str], body: Sequence[str]) -> list[str]:
    title = wrap_line(f"pure subroutine {name}({', '.join(declared)})", LANGUAGE, "")
    return [*title, *_indented([*declared.values(), *body]), f"end subroutine {name}"]


def _locals(names: Sequence[str]) -> list[str]:
    """Return the declarations of local names, as many per line as fit."""
    return [f"real(dp) :: {row}" for row in in_rows(names, LANGUAGE.width - 20)]


def _part(function: Function, number: int) -> list[str]:
    """Return one part as a subroutine of the arrays that it uses."""
    part = function.composition.parts[number]
    declared = {a.name: _declared(a, "in") for a in function.arguments}
    declared |= {r.name: _declared(r, "inout") for r in function.results}
    declared |= {name: f"real(dp), intent(inout) :: {name}({size})" for name, size in function.arrays}
    used = {name: text for name, text in declared.items() if name in part.mentions}
    body = [*_locals(part.locals), "", *part_lines(part, LANGUAGE, function.shapes, "")]
    return _procedure(f"{function.name}_part{number + 1}", used, body)


def _call(function: Function, number: int) -> str:
    names = [array.name for array in (*function.arguments, *function.results)]
    names += [name for name, _ in function.arrays]
    mentioned = function.composition.parts[number].mentions
    return f"call {function.name}_part{number + 1}({', '.join(name for name in names if name in mentioned)})"


_COMPARE = """
! Compare an array with its reference, relative to the largest entry; zeros may differ by rounding.
subroutine compare(what, value, reference)
    character(*), intent(in) :: what
    real(dp), intent(in) :: value(:), reference(:)
    real(dp) :: largest, error
    character(7) :: verdict

    largest = maxval(abs(reference))
    error = maxval(abs(value - reference))
    verdict = "ok"
    if (.not. all(abs(value - reference) <= 1e-12_dp*largest + 1e-15_dp)) then
        verdict = "DIFFERS"
        failures = failures + 1
    end if
    if (largest > 0.0_dp) error = error/largest
    print "(2x, a44, i6, es11.1, 2x, a)", [character(44) :: what], size(reference), error, trim(verdict)
end subroutine compare
"""


def _check(module: Module) -> str:
    title = [mark(module), "", "Evaluates every routine at one state and compares with reference values."]
    lines = [*comment_lines(title, "!"), f"program {module.name}_check"]
    body = ["use, intrinsic :: iso_fortran_env, only: dp => real64", f"use {module.name}", "implicit none"]
    for array in module.arguments:
        if array.name in module.values:
            body += _parameter(array, module.values[array.name])
    if module.prepare:
        body += [_variable(result) for result in module.prepare.results]
    body += ["integer :: failures = 0", "", f'print "(a)", "{module.name}: entries, largest relative error"']
    body += [_call_of(module.prepare)] if module.prepare else []
    body += [f"call check_{function.name}()" for function in module.routines]
    lines += [*_indented([*body, "if (failures > 0) stop 1"]), "", "contains"]
    for function, references in zip(module.routines, module.references, strict=True):
        lines += _indented(["", *_comparison(function, references)])
    lines += _indented(["", *_COMPARE.strip().splitlines()])
    return "\n".join([*lines, "", f"end program {module.name}_check"]) + "\n"


def _parameter(array: Array, values: Sequence[float]) -> list[str]:
    literals = ", ".join(map(LANGUAGE.literal, values))
    shape, value = ("", literals) if array.is_scalar else (f"({array.size})", f"[{literals}]")
    return wrap_line(f"real(dp), parameter :: {array.name}{shape} = {value}", LANGUAGE, "")


def _variable(array: Array) -> str:
    shape = f"({', '.join(map(str, array.shape))})" if array.shape else ""
    return f"real(dp) :: {array.name}{shape}"


def _comparison(function: Function, references: Sequence[Sequence[float]]) -> list[str]:
    """Return a subroutine that calls a routine and compares its results."""
    body = [*map(_variable, function.results), f"real(dp) :: reference({max(map(len, references))})", ""]
    body += wrap_line(_call_of(function), LANGUAGE, "")
    for result, reference in comparisons(function, references):
        body += _assigned(reference)
        flat = {
            0: "[{}]",
            1: "{}",
            2: f"reshape(transpose({{}}), [{result.size}])",
        }[len(result.shape)].format(result.name)
        what = f"{function.name}: {result.name}"
        body += wrap_line(f'call compare("{what}", {flat}, reference(:{result.size}))', LANGUAGE, "")
    return [f"subroutine check_{function.name}()", *_indented(body), f"end subroutine check_{function.name}"]


def _assigned(reference: Sequence[float]) -> list[str]:
    """Return several assignments of some values each, since a statement may have at most 255 lines."""
    lines = []
    for first in range(0, len(reference), 4):
        part = reference[first : first + 4]
        literals = ", ".join(map(LANGUAGE.literal, part))
        lines += wrap_line(f"reference({first + 1}:{first + len(part)}) = [{literals}]", LANGUAGE, "")
    return lines


def _call_of(function: Function) -> str:
    return (
        f"call {function.name}({', '.join(array.name for array in (*function.arguments, *function.results))})"
    )


def _makefile(module: Module) -> str:
    name = module.name
    return f"""\
# {mark(module)}
# make: compile; make check: compile and compare with the reference values.

ifeq ($(origin FC),default)
FC = gfortran
endif
FFLAGS ?= -std=f2008 -O1 -Wall -pedantic -Wno-unused-dummy-argument

all: {name}.o

{name}.o: {name}.f90
\t$(FC) $(FFLAGS) -c {name}.f90 -o $@

{name}_check: {name}_check.f90 {name}.o
\t$(FC) $(FFLAGS) {name}_check.f90 {name}.o -o $@

check: {name}_check
\t./{name}_check

clean:
\trm -f {name}.o {name}.mod {name}_check

.PHONY: all check clean
"""


FORTRAN = Target(
    name="fortran",
    title="Fortran 2008",
    language=LANGUAGE,
    files=_files,
    check=("make check",),
    tools=("gfortran",),
)
