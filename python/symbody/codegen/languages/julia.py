"""Julia: a module and a self-check."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.codegen.languages.heads import (
    comment_lines,
    comparisons,
    head,
    head_of_function,
    mark,
    with_own_result_names,
)
from symbody.codegen.languages.target import Target
from symbody.codegen.layout.code_text import part_lines, wrap_line, wrap_lines
from symbody.codegen.layout.language import Language, functions, number_text
from symbody.codegen.layout.module import Array, Function, Module
from symbody.codegen.runtime.snippets import SNIPPETS
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["JULIA"]

_NAMES = """
baremodule begin break catch const continue do else elseif end export false finally for function global if import in
isa let local macro module mutable primitive quote return struct true try type using where while abstract
abs acos asin atan cos cosh exp log max min sign sin sinh sqrt tan tanh ifelse pi im Inf NaN undef Array Vector Matrix
eltype promote_type reshape permutedims number compare reference failures linear_solve exit println include
real_sqrt real_log real_asin real_acos real_power same main Base Core Main
"""

LANGUAGE = Language(
    comment=("#", ""),
    declare="{name} = {value}",
    assign="{place} = {value}",
    functions=functions(
        **{name: f"real_{name}({{}})" for name in ("sqrt", "log", "asin", "acos")},
        atan2="atan({}, {})",
        Abs="abs({})",
        Min="min({}, {})",
        Max="max({}, {})",
        Power="real_power({}, {})",
        select="ifelse({} > 0, {}, {})",
    ),
    reserved=frozenset(_NAMES.split()),
    literal=lambda value: {"inf": "Inf", "-inf": "-Inf", "nan": "NaN"}.get(repr(value), number_text(value)),
    matrix="{}[{}, {}]",
    first_index=1,
    clear="fill!({array}, 0)",
    solve="{x} .= linear_solve(permutedims(reshape({work}, {n}, {n})), {x})",
)

# Outside of their domains these return NaN, as in other languages; Julia's own functions throw errors.
_HELPERS = {
    Operation.SQRT: "real_sqrt(x) = x < 0 ? NaN*x : sqrt(x)",
    Operation.LOG: "real_log(x) = x < 0 ? NaN*x : log(x)",
    Operation.ASIN: "real_asin(x) = abs(x) > 1 ? NaN*x : asin(x)",
    Operation.ACOS: "real_acos(x) = abs(x) > 1 ? NaN*x : acos(x)",
    Operation.POWER: "real_power(x, y) = x < 0 && !isinteger(y) ? NaN*x : x^y",
}


def _files(module: Module) -> dict[str, str]:
    return {f"{module.name}.jl": _source(module), f"{module.name}_check.jl": _check(module)}


def _source(module: Module) -> str:
    title = "Functions of the model, of vectors and numbers; they return arrays and numbers of the arguments' type."
    lines = [*comment_lines(head(module, title, 1), "#"), f"module {module.name}", ""]
    exported = ", ".join(function.name for function in module.functions)
    lines += wrap_line(f"export {exported}", LANGUAGE, "")
    for function in module.functions:
        lines += ["", *_function(function)]
    helpers = [text for name, text in _HELPERS.items() if name in module.operations]
    lines += ["", *helpers] if helpers else []
    if Operation.FACTOR in module.operations:
        lines += ["", SNIPPETS["julia"].strip()]
    return "\n".join([*lines, "", "end"]) + "\n"


def _function(function: Function) -> list[str]:
    """Return a function; if it is long, one that calls its parts, and these."""
    parts = function.composition.parts
    types = ", ".join(f"eltype({array.name})" for array in function.arguments)
    lines = ["    number = promote_type(Float64" + (f", {types})" if types else ")")]
    arrays = [(result.name, ", ".join(map(str, result.shape))) for result in function.results if result.shape]
    arrays += [(name, str(size)) for name, size in function.working]
    lines += [f"    {name} = Array{{number}}(undef, {size})" for name, size in arrays]
    returned = ", ".join(result.name for result in function.results)
    lines += wrap_lines([_assignment(call) for call in function.calls], LANGUAGE, "    ")
    definitions: list[str] = []
    if len(parts) == 1:
        lines += part_lines(parts[0], LANGUAGE, function.shapes)
    else:
        lines += wrap_lines([_call(function, k) for k in range(len(parts))], LANGUAGE, "    ")
        definitions = [line for k in range(len(parts)) for line in ["", *_part(function, k)]]
    title = f"function {function.name}({', '.join(array.name for array in function.arguments)})"
    comments = comment_lines(head_of_function(function), "#")
    return [*comments, *wrap_line(title, LANGUAGE, ""), *lines, f"    return {returned}", "end", *definitions]


def _passed(function: Function, number: int) -> str:
    """Return the arrays and numbers that a part takes."""
    names = [array.name for array in function.arguments]
    names += [result.name for result in function.results if not result.is_scalar]
    names += [name for name, _ in function.arrays]
    mentioned = function.composition.parts[number].mentions
    return ", ".join(name for name in names if name in mentioned)


def _returned(function: Function, number: int) -> str:
    """Return the results that are numbers: a part can't assign to them in place."""
    mentioned = function.composition.parts[number].mentions
    return ", ".join(r.name for r in function.results if r.is_scalar and r.name in mentioned)


def _call(function: Function, number: int) -> str:
    returned = _returned(function, number)
    call = f"{function.name}_part{number + 1}({_passed(function, number)})"
    return f"{returned} = {call}" if returned else call


def _part(function: Function, number: int) -> list[str]:
    """Return one part as a function of the arrays that it uses."""
    part = function.composition.parts[number]
    title = f"function {function.name}_part{number + 1}({_passed(function, number)})"
    lines = [*wrap_line(title, LANGUAGE, ""), *part_lines(part, LANGUAGE, function.shapes)]
    return [*lines, f"    return {_returned(function, number)}".rstrip(), "end"]


_COMPARE = """
# Compare with a reference, relative to its largest entry; zeros may differ by rounding.
function compare(what, value, reference)
    rows = value isa AbstractMatrix ? vec(permutedims(value)) : vec(collect(value))
    largest = maximum(abs, reference)
    error = maximum(abs, rows - reference)
    same = all(abs.(rows - reference) .<= 1e-12*largest + 1e-15)
    println("  ", rpad(what, 44), lpad(length(reference), 5), "  ", error/(largest > 0 ? largest : 1),
        same ? "  ok" : "  DIFFERS")
    return same
end
"""


def _check(module: Module) -> str:
    title = [mark(module), "", "Evaluates every routine at one state and compares with reference values."]
    lines = [*comment_lines(title, "#"), f'include("{module.name}.jl")', *_COMPARE.rstrip().split("\n"), ""]
    lines += ["function main()"]
    package = f"{module.name}."
    for array in module.arguments:
        if array.name in module.values:
            literals = ", ".join(map(LANGUAGE.literal, module.values[array.name]))
            value = literals if array.is_scalar else f"[{literals}]"
            lines += wrap_line(f"{array.name} = {value}", LANGUAGE, "    ")
    lines += ["    same = true", f'    println("{module.name}: entries, largest relative error")']
    lines += [f"    {_assignment(module.prepare, package)}"] if module.prepare else []
    for routine, references in zip(module.routines, module.references, strict=True):
        function = with_own_result_names(module, routine)
        lines += ["", *wrap_line(_assignment(function, package), LANGUAGE, "    ")]
        for result, reference in comparisons(function, references):
            lines += _comparison(function, result, reference)
    return "\n".join([*lines, "", "    return same", "end", "", "main() || exit(1)"]) + "\n"


def _assignment(function: Function, package: str = "") -> str:
    """Return the line that calls a function, of the package, if that is given."""
    results = ", ".join(result.name for result in function.results)
    arguments = ", ".join(array.name for array in function.arguments)
    return f"{results} = {package}{function.name}({arguments})"


def _comparison(function: Function, result: Array, reference: Sequence[float]) -> list[str]:
    literals = ", ".join(map(LANGUAGE.literal, reference))
    call = f'same &= compare("{function.name}: {result.name}", {result.name}, reference)'
    return [*wrap_line(f"reference = [{literals}]", LANGUAGE, "    "), *wrap_line(call, LANGUAGE, "    ")]


JULIA = Target(
    name="julia",
    title="Julia",
    language=LANGUAGE,
    files=_files,
    check=("julia --startup-file=no {name}_check.jl",),
)
