"""Python with NumPy: a module and a self-check; what other libraries of Python share with it."""

from __future__ import annotations

import builtins
import keyword
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from symbody.codegen.languages.heads import (
    comparisons,
    head,
    head_of_function,
    mark,
    with_own_result_names,
)
from symbody.codegen.languages.target import Target
from symbody.codegen.layout.code_text import part_lines, wrap_line
from symbody.codegen.layout.language import Language, functions, number_text
from symbody.codegen.layout.module import Array, Function, Module
from symbody.codegen.runtime.snippets import SNIPPETS
from symbody.codegen.straight_line.instruction import Operation

__all__ = [
    "PYTHON",
    "Library",
    "check_text",
    "function_lines",
    "module_text",
    "python_language",
    "values_lines",
]

_OWN = "np jnp jax ca math entries shape array square linear_solve compare main function model same sys"
_RESERVED = frozenset([*keyword.kwlist, *keyword.softkwlist, *dir(builtins), *_OWN.split()])
_LIBRARIES = "numpy scipy jax jaxlib ml_dtypes opt_einsum casadi symbody sitecustomize usercustomize"
_MODULES = frozenset([*keyword.kwlist, *sys.stdlib_module_names, *_LIBRARIES.split()])
"""A file of one of these names would be imported instead of the library."""


def python_language(prefix: str, **other: str) -> Language:
    """Return Python's syntax with the functions of a module, such as ``np``; ``other`` gives those with other texts."""
    named = {"asin": "arcsin", "acos": "arccos", "atan": "arctan", "sign": "sign", "Abs": "abs"}
    own = {name: f"{prefix}.{named.get(name, name)}({{}})" for name in _ONE_ARGUMENT}
    pairs = {name: f"{prefix}.{text}" for name, text in _MORE_ARGUMENTS.items()}
    return Language(
        comment=("#", ""),
        declare="{name} = {value}",
        assign="{place} = {value}",
        functions=functions(**{**own, **pairs, **other}),
        reserved=_RESERVED,
        reserved_programs=_MODULES,
        literal=number_text,
        factor="{work} = square({work}, {n})",
        solve="{x} = linear_solve({work}, {x})",
        continuation=" \\",
    )


_ONE_ARGUMENT = (
    "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log", "Abs", "sign",
)  # fmt: skip
_MORE_ARGUMENTS = {
    "atan2": "arctan2({}, {})",
    "Min": "minimum({}, {})",
    "Max": "maximum({}, {})",
    "Power": "power({}, {})",
    "select": "where({} > 0.0, {}, {})",
}

LANGUAGE = python_language("np")

_ARRAY = '''
def array(entries, shape):
    """Return the entries, each a number or an array of a batch, as one array that begins with the shape."""
    entries = np.broadcast_arrays(*entries)
    return np.array(entries, dtype=float).reshape(shape + entries[0].shape)
'''

_SQUARE = '''
def square(entries, n):
    """Return the entries of a matrix, row by row, as matrices along the last two axes."""
    return np.moveaxis(array(entries, (n, n)), (0, 1), (-2, -1))
'''


@dataclass(frozen=True)
class Library:
    """The code that a library of Python needs around the functions.

    Attributes:
        language: its syntax.
        title: what the functions take and return, for the head of the file.
        imports: the lines of imports.
        helpers: the texts of the functions that make arrays, and of those that solve linear systems.
        called: how the self-check calls a function, with ``{function}``, ``{arguments}`` and the module's ``{name}``.
        passed: how a function passes an array that it was given to another one.
    """

    language: Language
    title: str
    imports: tuple[str, ...]
    helpers: str
    systems: str
    called: str = "model.{function}({arguments})"
    passed: str = "{}"


NUMPY = Library(
    LANGUAGE,
    "Functions of the model. Arguments are sequences, or arrays with a row for each entry and any batch of states "
    "along further axes; results are arrays that begin with the shape given here, numbers and the batch for all.",
    ("import numpy as np",),
    _ARRAY,
    _SQUARE + "\n" + SNIPPETS["numpy"],
)


def module_text(module: Module, library: Library, after: Sequence[str] = ()) -> str:
    """Return the module: head, imports, helpers, a function for each routine, and further lines."""
    lines = ['"""' + head(module, library.title, 0)[0], *head(module, library.title, 0)[1:], '"""', ""]
    lines += [*library.imports, "", *library.helpers.splitlines(), ""]
    if Operation.FACTOR in module.operations:
        lines += [*library.systems.splitlines(), ""]
    for function in module.functions:
        lines += ["", *function_lines(function, library), ""]
    return "\n".join([*lines, *after]).rstrip() + "\n"


def function_lines(function: Function, library: Library) -> list[str]:
    """Return a function of sequences that returns arrays and numbers."""
    arguments = ", ".join(array.name for array in function.arguments)
    lines = [f"def {function.name}({arguments}):", *_docstring(function)]
    lines += [f"    {r.name} = [0.0] * {r.size}" for r in function.results if not r.is_scalar]
    lines += [f"    {name} = [0.0] * {size}" for name, size in _working(function)]
    for call in function.calls:
        lines += wrap_line(_assignment(call, library), library.language, "    ")
    for part in function.composition.parts:
        lines += part_lines(part, library.language, function.shapes)
    returned = ", ".join(map(_returned, function.results))
    return [*lines, *wrap_line(f"return {returned}", library.language, "    ")]


def _assignment(function: Function, library: Library) -> str:
    """Return the call of a function inside another one, which has its arguments."""
    names = ", ".join(result.name for result in function.results)
    passed = [a.name if a.is_scalar else library.passed.format(a.name) for a in function.arguments]
    return f"{names} = {function.name}({', '.join(passed)})"


def _docstring(function: Function) -> list[str]:
    """Return what it computes, results and operations; the first line alone where nothing follows."""
    title, *rest = head_of_function(function)
    lines = [title, "", "Returns:", *rest]
    return [f'    """{title}', *(f"    {line}".rstrip() for line in lines[1:]), '    """']


def _working(function: Function) -> list[tuple[str, int]]:
    made = function.composition
    return [*((name, n * n) for name, n in made.matrices), *made.solutions]


def _returned(result: Array) -> str:
    shape = f"{result.shape[0]}," if len(result.shape) == 1 else ", ".join(map(str, result.shape))
    return result.name if result.is_scalar else f"array({result.name}, ({shape}))"


_COMPARE = '''
def compare(what, value, reference):
    """Compare an array with its reference, relative to the largest entry; zeros may differ by rounding."""
    value, reference = np.ravel(np.array(value, dtype=float)), np.array(reference)
    largest, error = np.max(np.abs(reference)), np.max(np.abs(value - reference))
    same = bool(error <= 1e-12 * largest + 1e-15)
    relative = error / largest if largest > 0.0 else error
    print(f"  {what:44s} {len(reference):5d} {relative:10.1e}  {'ok' if same else 'DIFFERS'}")
    return same
'''


def check_text(module: Module, library: Library) -> str:
    """Return the self-check: a script that evaluates every routine at one state."""
    title = (
        f'"""{mark(module)}\n\nEvaluates every routine at one state and compares with reference values.\n"""'
    )
    imports = ["import sys", "", *_all_imports(library), "", f"import {module.name} as model", ""]
    lines = [*title.splitlines(), "", *imports, *_COMPARE.splitlines(), "", "", "def main():"]
    lines += values_lines(module)
    lines += [f'    print("{module.name}: entries, largest relative error")', "    same = True"]
    if module.prepare:
        lines += [f"    {module.prepare.results[0].name} = {_call(module, module.prepare, library)}"]
    for routine, references in zip(module.routines, module.references, strict=True):
        function = with_own_result_names(module, routine)
        names = ", ".join(result.name for result in function.results)
        lines += ["", *wrap_line(f"{names} = {_call(module, function, library)}", library.language, "    ")]
        for result, reference in comparisons(function, references):
            literals = ", ".join(map(repr, reference))
            call = f'compare("{function.name}: {result.name}", {result.name}, [{literals}])'
            lines += wrap_line(f"same = {call} and same", _BRACKETED, "    ")
    lines += ["", "    return 0 if same else 1", "", "", 'if __name__ == "__main__":', "    sys.exit(main())"]
    return "\n".join(lines) + "\n"


_BRACKETED = Language(("#", ""), "", "", {}, frozenset(), number_text)
"""Within brackets lines may end anywhere."""


def _all_imports(library: Library) -> list[str]:
    return sorted({*library.imports, "import numpy as np"})


def values_lines(module: Module) -> list[str]:
    """Return the lines that give the arguments their values."""
    lines = []
    for name, values in module.values.items():
        is_scalar = any(array.name == name and array.is_scalar for array in module.arguments)
        text = repr(values[0]) if is_scalar else f"[{', '.join(map(repr, values))}]"
        lines += wrap_line(f"{name} = {text}", _BRACKETED, "    ")
    return lines


def _call(module: Module, function: Function, library: Library) -> str:
    arguments = ", ".join(array.name for array in function.arguments)
    return library.called.format(function=function.name, arguments=arguments, name=module.name)


def files_with(library: Library) -> Callable[[Module], dict[str, str]]:
    """Return the printer of a module and its check program in Python with an array library."""
    return lambda module: {
        f"{module.name}.py": module_text(module, library),
        f"{module.name}_check.py": check_text(module, library),
    }


PYTHON = Target(
    name="python",
    title="Python with NumPy",
    language=LANGUAGE,
    files=files_with(NUMPY),
    check=("python {name}_check.py",),
    limit=None,
)
