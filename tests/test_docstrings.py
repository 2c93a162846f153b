"""What a docstring has to have: an example for each public name, the arguments where there are many."""

import ast
import inspect
from collections.abc import Iterator
from pathlib import Path

import symbody
from scripts.sizes import statements

HOME = Path(symbody.__file__).parent
MANY = 5
"""Arguments from which on a docstring lists them."""
PUBLIC = [name for name in symbody.__all__ if callable(getattr(symbody, name))]


def test_each_public_name_has_an_example() -> None:
    assert [name for name in PUBLIC if ">>> " not in (inspect.getdoc(getattr(symbody, name)) or "")] == []


def _functions(tree: ast.AST) -> Iterator[tuple[ast.FunctionDef, str]]:
    """Yield functions with the docstring that describes their arguments: for a constructor also that of its class."""
    for node in statements(tree):
        if isinstance(node, ast.ClassDef):
            described = ast.get_docstring(node) or ""
            for method in node.body:
                if isinstance(method, ast.FunctionDef) and method.name == "__init__":
                    yield method, described + (ast.get_docstring(method) or "")
        elif isinstance(node, ast.FunctionDef) and node.name != "__init__" and not _is_overload(node):
            yield node, ast.get_docstring(node) or ""


def _is_overload(function: ast.FunctionDef) -> bool:
    """Return whether this is one signature of a function; the implementation after it describes the arguments."""
    return any(isinstance(mark, ast.Name) and mark.id == "overload" for mark in function.decorator_list)


def _arguments(function: ast.FunctionDef) -> list[str]:
    given = function.args
    names = [each.arg for each in (*given.posonlyargs, *given.args, *given.kwonlyargs)]
    return [name for name in names if name not in {"self", "cls"}]


def _missing(path: Path) -> Iterator[str]:
    """Yield the arguments that the docstrings of a file don't list, with their functions and places."""
    for function, text in _functions(ast.parse(path.read_text(encoding="utf-8"))):
        names = _arguments(function)
        listed = text.partition("Args:")[2] or text.partition("Attributes:")[2]
        for name in names if len(names) >= MANY else []:
            if f"{name}:" not in listed and f"{name}," not in listed:
                yield f"{path.relative_to(HOME).as_posix()}, line {function.lineno}, {function.name}: {name}"


def test_functions_of_many_arguments_list_them() -> None:
    assert [place for path in sorted(HOME.rglob("*.py")) for place in _missing(path)] == []
