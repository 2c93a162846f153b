"""MATLAB and Octave: a package with a file for every function, and a self-check."""

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

__all__ = ["MATLAB"]

_NAMES = """
break case catch classdef continue else elseif end for function global if otherwise parfor persistent return
spmd switch try while do until unwind_protect endfunction endif endfor endwhile end_try_catch i j I J e pi eps
Inf NaN inf nan ans class double char size numel all any isequal functions ones zeros abs acos asin atan atan2
cos cosh exp log max min power sign sin sinh sqrt tan tanh isnan select least greatest real imag real_or_nan
compare fprintf error reshape linear_solve same reference
"""

_SOMETIMES_COMPLEX = ("sqrt", "log", "asin", "acos")
_REAL = """
function value = real_or_nan(value)
    if imag(value) == 0.0
        value = real(value);
    else
        value = NaN;
    end
end
"""

LANGUAGE = Language(
    comment=("%", ""),
    declare="{name} = {value};",
    assign="{place} = {value};",
    functions=functions(
        **{name: f"real_or_nan({name}({{}}))" for name in _SOMETIMES_COMPLEX},
        Abs="abs({})",
        Min="least({}, {})",
        Max="greatest({}, {})",
        Power="real_or_nan(power({}, {}))",
    ),
    reserved=frozenset(_NAMES.split()),
    literal=number_text,
    entry="{}({})",
    matrix="{}({}, {})",
    first_index=1,
    solve="{x} = linear_solve(reshape({work}, {n}, {n}).', {x});",
    continuation=" ...",
)

_HELPERS = {
    **dict.fromkeys((*_SOMETIMES_COMPLEX, "Power"), _REAL),
    Operation.SELECT: """
function value = select(condition, positive, other)
    value = other;
    if condition > 0.0
        value = positive;
    end
end
""",
    Operation.MIN: """
function value = least(a, b)
    value = b;
    if a < b || isnan(a)
        value = a;
    end
end
""",
    Operation.MAX: """
function value = greatest(a, b)
    value = b;
    if a > b || isnan(a)
        value = a;
    end
end
""",
}


def _files(module: Module) -> dict[str, str]:
    folder = f"+{module.name}"
    return {
        f"{folder}/Contents.m": _contents(module),
        **{f"{folder}/{function.name}.m": _file(module, function) for function in module.functions},
        f"{module.name}_check.m": _check(module),
    }


def _contents(module: Module) -> str:
    title = "Functions of the model; arguments are vectors, results are columns, matrices and numbers."
    lines = [*head(module, title, 1), "", "Functions:", ""]
    for function in module.functions:
        lines += [f"  {line}" for line in wrap_line(_signature(module, function), LANGUAGE, "")]
    return "\n".join(comment_lines(lines, "%")) + "\n"


def _returned(function: Function) -> str:
    names = [result.name for result in function.results]
    return names[0] if len(names) == 1 else f"[{', '.join(names)}]"


def _signature(module: Module | None, function: Function) -> str:
    """Return how a function is called; with its package, if that is given."""
    package = f"{module.name}." if module else ""
    arguments = ", ".join(array.name for array in function.arguments)
    return f"{_returned(function)} = {package}{function.name}({arguments})"


def _file(module: Module, function: Function) -> str:
    lines = comment_lines([mark(module), "", *head_of_function(function)], "%")
    lines += wrap_line(f"function {_signature(None, function)}", LANGUAGE, "")
    arrays = [(result.name, _zeros(result)) for result in function.results if not result.is_scalar]
    arrays += [(name, f"zeros({size}, 1)") for name, size in function.working]
    lines += [f"    {name} = {zeros};" for name, zeros in arrays]
    lines += wrap_lines([f"{_signature(module, call)};" for call in function.calls], LANGUAGE, "    ")
    for part in function.composition.parts:
        lines += part_lines(part, LANGUAGE, function.shapes)
    helpers = list(dict.fromkeys(text for name, text in _HELPERS.items() if name in function.operations))
    if Operation.FACTOR in function.operations:
        helpers.append(SNIPPETS["matlab"])
    return "\n".join([*lines, "end", *(line for text in helpers for line in ["", text.strip()])]) + "\n"


def _zeros(array: Array) -> str:
    rows, columns = (*array.shape, 1)[:2]
    return f"zeros({rows}, {columns})"


_COMPARE = """
function same = compare(what, value, reference)
% Compare an array with its reference, relative to the largest entry; zeros may differ by rounding.
    largest = max(abs(reference(:)));
    differences = abs(value(:) - reference(:));
    same = isequal(size(value), size(reference)) && all(differences <= 1e-12*largest + 1e-15);
    verdict = 'DIFFERS';
    if same
        verdict = 'ok';
    end
    if largest == 0.0
        largest = 1.0;
    end
    fprintf('  %-44s %5d %10.1e  %s\\n', what, numel(reference), max(differences)/largest, verdict);
end
"""


def _check(module: Module) -> str:
    title = [mark(module), "", "Evaluates every routine at one state and compares with reference values."]
    lines = [*comment_lines(title, "%"), f"function {module.name}_check()"]
    for name, values in module.values.items():
        lines += _wrapped_list(f"{name} = {_column(values)};")
    lines += [f"    fprintf('{module.name}: entries, largest relative error\\n');", "    same = true;"]
    lines += [f"    {_signature(module, module.prepare)};"] if module.prepare else []
    for routine, references in zip(module.routines, module.references, strict=True):
        function = with_own_result_names(module, routine)
        lines += ["", *wrap_line(f"{_signature(module, function)};", LANGUAGE, "    ")]
        for result, reference in comparisons(function, references):
            lines += _reference(result, reference)
            call = f"compare('{function.name}: {result.name}', {result.name}, reference)"
            lines += wrap_line(f"same = {call} && same;", LANGUAGE, "    ")
    lines += [
        "",
        "    if ~same",
        f"        error('{module.name}: results differ from the reference');",
        "    end",
    ]
    return "\n".join([*lines, "end", *_COMPARE.rstrip().splitlines()]) + "\n"


def _reference(result: Array, reference: Sequence[float]) -> list[str]:
    text = _column(reference)
    if len(result.shape) == 2:
        rows, columns = result.shape
        text = f"reshape({text}, {columns}, {rows}).'"
    return _wrapped_list(f"reference = {text};")


def _column(values: Sequence[float]) -> str:
    literals = "; ".join(map(LANGUAGE.literal, values))
    return literals if len(values) == 1 else f"[{literals}]"


def _wrapped_list(line: str) -> list[str]:
    """Return a line with a list of numbers in several ones: within brackets a line may end after a semicolon."""
    parts = line.split("; ")
    lines = ["    " + parts[0]]
    for part in parts[1:]:
        if len(lines[-1]) + len(part) + 8 > LANGUAGE.width:
            lines[-1] += "; ..."
            lines.append("        " + part)
        else:
            lines[-1] += f"; {part}"
    return lines


MATLAB = Target(
    name="matlab",
    title="MATLAB and Octave",
    language=LANGUAGE,
    files=_files,
    check=("octave-cli --norc --no-history --eval {name}_check",),
    limit=None,
)
