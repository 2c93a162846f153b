"""Modelica: a package of functions, and a self-check as a function of the package."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody.codegen.languages.heads import (
    comment_lines,
    comparisons,
    head,
    head_of_function,
    in_rows,
    mark,
    sentences,
)
from symbody.codegen.languages.target import Target
from symbody.codegen.layout.code_text import part_lines, wrap_line
from symbody.codegen.layout.language import Language, functions, number_text
from symbody.codegen.layout.module import Array, Function, Module
from symbody.codegen.runtime.snippets import SNIPPETS
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["MODELICA"]

_RESERVED = """
algorithm and annotation assert block break class connect connector constant constrainedby der discrete each else
elseif elsewhen encapsulated end enumeration equation expandable extends external false final flow for function if
import impure in initial inner input loop model not operator or outer output package parameter partial protected
public pure record redeclare replaceable return stream then true type when while within
Real Integer Boolean String time abs sign sqrt sin cos tan asin acos atan atan2 sinh cosh tanh exp log min max
Modelica ModelicaServices ModelicaReference Complex transpose reference same
self_check pre edge change sample delay homotopy noEvent smooth size fill zeros
"""

LANGUAGE = Language(
    comment=("//", ""),
    declare="{name} := {value};",
    assign="{place} := {value};",
    functions=functions(
        Abs="abs({})",
        sign="sign({})",
        Min="min({}, {})",
        Max="max({}, {})",
        Power="({})^({})",
        select="(if {} > 0.0 then {} else {})",
    ),
    reserved=frozenset(_RESERVED.split()),
    literal=number_text,
    matrix="{}[{}, {}]",
    first_index=1,
    clear="{array} := fill(0.0, {sizes});",
    factor="// {work} is factorised where it is used",
    solve="{x} := linear_solve({work}, {x});",
)


def _files(module: Module) -> dict[str, str]:
    title = "Functions of the model; arguments are vectors, results are vectors, matrices and numbers."
    lines = [f'package {module.name} "{_quoted(_first_line(module))}"']
    lines += [f"  {line}" for line in comment_lines(head(module, title, 1), "//")]
    if Operation.FACTOR in module.operations:
        lines += ["", *(f"  {line}".rstrip() for line in _systems())]
    for function in module.functions:
        lines += ["", *(f"  {line}".rstrip() for line in _function(function))]
    lines += ["", *(f"  {line}".rstrip() for line in _check(module)), f"end {module.name};"]
    return {f"{module.name}.mo": "\n".join(lines) + "\n", f"{module.name}_check.mos": _script(module)}


def _first_line(module: Module) -> str:
    """Return the meaning of the model in one line, shortened if necessary."""
    first, *more = sentences(module.meaning.partition("\n")[0]) or [module.name]
    return f"{first} ..." if more else first


def _script(module: Module) -> str:
    """Return a script of OpenModelica that loads the package and runs its self-check."""
    return f"""\
// {mark(module)}
loadFile("{module.name}.mo");
if {module.name}.self_check() then
  print("{module.name}: ok\\n");
else
  print("{module.name}: DIFFERS from the reference\\n");
  exit(1);
end if;
"""


def _systems() -> list[str]:
    return SNIPPETS["modelica"].strip().splitlines()


def _quoted(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')


def _declaration(kind: str, array: Array) -> str:
    meaning = f' "{_quoted(sentences(array.meaning, 70)[0])}"' if array.meaning.strip() else ""
    return f"  {kind}{_typed(array.name, array.shape)}{meaning};"


def _typed(name: str, shape: Sequence[int]) -> str:
    return f"Real {name}[{', '.join(map(str, shape))}]" if shape else f"Real {name}"


def _function(function: Function) -> list[str]:
    title, *more = head_of_function(function) or [function.name]
    lines = [
        f'function {function.name} "{_quoted(title)}"',
        *(f"  {line}" for line in comment_lines(more, "//")),
    ]
    lines += [_declaration("input ", array) for array in function.arguments]
    lines += [_declaration("output ", array) for array in function.results]
    protected = list(_protected(function))
    lines += ["protected", *protected] if protected else []
    lines += ["algorithm"]
    for call in function.calls:
        lines += wrap_line(_call(call, [result.name for result in call.results]), LANGUAGE, "  ")
    shapes = {**function.shapes, **{name: (n, n) for name, n in function.composition.matrices}}
    for part in function.composition.parts:
        lines += part_lines(part, LANGUAGE, shapes, "  ")
    return [*lines, f"end {function.name};"]


def _protected(function: Function) -> Iterable[str]:
    """Return the declarations of the local names, several per line, and of the matrices of linear systems."""
    made = function.composition
    names = [name for part in made.parts for name in part.locals]
    yield from (f"  Real {row};" for row in in_rows(names, 90))
    yield from (f"  Real {name}[{n}, {n}];" for name, n in made.matrices)
    yield from (f"  Real {name}[{n}];" for name, n in (*made.solutions, *function.received))


def _check(module: Module) -> list[str]:
    """Return a function that evaluates every routine at one state and compares with reference values."""
    lines = ['function self_check "Whether every routine gives the reference values at one state"']
    lines += ["  output Boolean same = true;", "protected"]
    scalars = {array.name for array in module.arguments if array.is_scalar}
    for name, values in module.values.items():
        text = number_text(values[0]) if name in scalars else f"{{{', '.join(map(number_text, values))}}}"
        shape = () if name in scalars else (len(values),)
        lines += wrap_line(f"{_typed(name, shape)} = {text};", LANGUAGE, "  ")
    if module.prepare:
        lines += [f"  {_typed(r.name, r.shape)};" for r in module.prepare.results]
    lines += [line for k, function in enumerate(module.routines, 1) for line in _results(k, function)]
    lines += ["algorithm"]
    lines += (
        [f"  {_call(module.prepare, [r.name for r in module.prepare.results])}"] if module.prepare else []
    )
    for k, (function, references) in enumerate(zip(module.routines, module.references, strict=True), 1):
        names = [f"{result.name}_{k}" for result in function.results]
        lines += wrap_line(_call(function, names), LANGUAGE, "  ")
        for result, reference in comparisons(function, references):
            lines += _comparison(f"{result.name}_{k}", result, reference)
    return [*lines, "end self_check;"]


def _results(number: int, function: Function) -> list[str]:
    return [f"  {_typed(f'{result.name}_{number}', result.shape)};" for result in function.results]


def _call(function: Function, names: Sequence[str]) -> str:
    arguments = ", ".join(array.name for array in function.arguments)
    left = names[0] if len(names) == 1 else f"({', '.join(names)})"
    return f"{left} := {function.name}({arguments});"


def _comparison(name: str, result: Array, reference: Sequence[float]) -> list[str]:
    largest = max(map(abs, reference), default=0.0)
    bound = number_text(1e-12 * largest + 1e-15)
    if result.is_scalar:
        return wrap_line(
            f"same := same and abs({name} - {_signed(reference[0])}) <= {bound};", LANGUAGE, "  "
        )
    test = f"same := same and max(abs({name} - {_literal(result.shape, reference)})) <= {bound};"
    return wrap_line(test, LANGUAGE, "  ")


def _signed(value: float) -> str:
    return f"({number_text(value)})" if value < 0 else number_text(value)


def _literal(shape: Sequence[int], values: Sequence[float]) -> str:
    rows = (
        [values] if len(shape) == 1 else [values[k : k + shape[1]] for k in range(0, len(values), shape[1])]
    )
    texts = [f"{{{', '.join(map(number_text, row))}}}" for row in rows]
    return texts[0] if len(shape) == 1 else f"{{{', '.join(texts)}}}"


MODELICA = Target(
    name="modelica",
    title="Modelica",
    language=LANGUAGE,
    files=_files,
    check=("omc {name}_check.mos",),
    limit=None,
)
