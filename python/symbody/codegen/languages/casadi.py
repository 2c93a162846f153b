"""CasADi: functions as graphs, to be differentiated and used in optimisation, and a self-check."""

from __future__ import annotations

from symbody.codegen.languages.python import Library, check_text, module_text, python_language
from symbody.codegen.languages.target import Target
from symbody.codegen.layout.code_text import wrap_line
from symbody.codegen.layout.module import Function, Module
from symbody.codegen.runtime.snippets import SNIPPETS
from symbody.codegen.straight_line.instruction import Operation

__all__ = ["CASADI"]

LANGUAGE = python_language(
    "ca",
    asin="ca.asin({})",
    acos="ca.acos({})",
    atan="ca.atan({})",
    atan2="ca.atan2({}, {})",
    Abs="ca.fabs({})",
    Min="ca.if_else({0} < {1}, {0}, {1})",
    Max="ca.if_else({0} > {1}, {0}, {1})",
    Power="ca.power({}, {})",
    select="ca.if_else({} > 0.0, {}, {})",
)

_ARRAY = '''
def array(entries, shape):
    """Return the entries, row by row, as a column or a matrix."""
    rows, columns = (*shape, 1)[:2]
    return ca.reshape(ca.vertcat(*entries), columns, rows).T


def function(name, body, arguments, results):
    """Return a function of columns, and of numbers, which have no size."""
    columns = [ca.{kind}.sym(argument, size or 1) for argument, size in arguments]
    values = body(*(c if size is None else ca.vertsplit(c) for c, (_, size) in zip(columns, arguments)))
    values = values if isinstance(values, tuple) else (values,)
    return ca.Function(name, columns, list(values), [argument for argument, _ in arguments], results)
'''

_SQUARE = '''
def square(entries, n):
    """Return the entries of a matrix, row by row, as a matrix."""
    return array(entries, (n, n))
'''

_TITLE = (
    "Functions of the model, as ca.Function objects of columns of numbers or symbols; results are columns, matrices "
    "and numbers."
)


def _library(module: Module) -> Library:
    """Return what CasADi needs: scalar graphs, or matrix graphs if linear systems are solved at run time."""
    kind = "MX" if Operation.FACTOR in module.operations else "SX"
    systems = _SQUARE + "\n" + SNIPPETS["casadi"]
    array = _ARRAY.replace("{kind}", kind)
    return Library(LANGUAGE, _TITLE, ("import casadi as ca",), array, systems, passed="ca.vertcat(*{})")


def _function(function: Function) -> list[str]:
    """Return the lines that turn the body of the same name into a CasADi function."""
    arguments = ", ".join(f'("{a.name}", {None if a.is_scalar else a.size})' for a in function.arguments)
    results = ", ".join(f'"{r.name}"' for r in function.results)
    line = f'{function.name} = function("{function.name}", {function.name}, [{arguments}], [{results}])'
    return wrap_line(line, LANGUAGE, "")


def _files(module: Module) -> dict[str, str]:
    library = _library(module)
    made = [line for function in module.functions for line in _function(function)]
    return {
        f"{module.name}.py": module_text(module, library, ["", *made]),
        f"{module.name}_check.py": check_text(module, library),
    }


CASADI = Target(
    name="casadi",
    title="Python with CasADi",
    language=LANGUAGE,
    files=_files,
    check=("python {name}_check.py",),
    limit=None,
)
