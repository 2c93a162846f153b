"""Linear modelling: small variables are marked, also in what was made before, and unmarked where the mode ends."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from symbody.geometry import Frame, Point, Vector, angular_velocity, origin, velocity
from symbody.multibody import Body, Force, Torque
from symbody.symbolic import Expr, Matrix, small, subs
from symbody.worksheet.convert.names import Names, NoText, identifier
from symbody.worksheet.convert.operations import SUM, grouped
from symbody.worksheet.convert.scalar_text import scalar_text
from symbody.worksheet.convert.sequences import item as several
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["on_the_master", "small_lines"]

_MARKED = (Expr, Matrix, Frame, Point, Vector, Body, Force, Torque, list, dict)


def small_lines(text: Writer, sets: tuple[syntax.Expression, ...]) -> list[str]:
    """Return the lines of ``linear_modeling``: ``x, psi = sb.small(x, psi)``."""
    names = text.names
    new = dict(pair for each in sets for pair in _deviations(text, each))
    old = {identifier(mark.name): mark for mark in names.small}
    entering = {name: about for name, about in new.items() if name not in old}
    leaving = {name: mark for name, mark in old.items() if name not in new}
    deviating = {name: mark for name, mark in leaving.items() if names.values[name] != mark}
    lines = [line for name, mark in deviating.items() for line in _taken_back(names, name, mark)]
    leaving = {name: mark for name, mark in leaving.items() if name not in deviating}
    changes = {names.values[name]: _deviation(names, name, about) for name, about in entering.items()}
    changes |= {mark: names.small[mark] for mark in leaving.values()}
    again = on_the_master(names, changes)
    older = [name for name in _made_before(names, changes) if name not in again]
    texts = {name: _marked(name, about) for name, about in entering.items()}
    texts |= {name: names.declared(name) for name in leaving}
    _keep(names, entering, [*deviating.values(), *leaving.values()])
    changed = _changed(names.own("marks"), texts, older) if older and texts else _named(entering, texts)
    return [*lines, *changed, *(names.made[name] for name in again)]


def _keep(names: Names, entering: Mapping[str, str], leaving: Sequence[Expr]) -> None:
    """Note which variables are small from now on."""
    for name, about in entering.items():
        plain = names.plain(name)
        names.small[small(plain)] = plain - (names.value(about) if about else 0)
    for mark in leaving:
        del names.small[mark]


def on_the_master(names: Names, changes: Mapping[Expr, Expr]) -> list[str]:
    """Return the names that are made again: the master frame, if its velocities change, and what hangs on it."""
    master = names.values.get(names.master)
    if not isinstance(master, Frame):
        return []
    rates = [*velocity(origin(master)).components, *angular_velocity(master).components]
    if subs(rates, changes) == rates:
        return []
    frames = {
        name: getattr(value, "frame", value) for name, value in names.values.items() if name in names.made
    }
    return [
        name
        for name, frame in frames.items()
        if isinstance(frame, Frame) and frame.ancestor.key == master.ancestor.key
    ]


def _taken_back(names: Names, name: str, mark: Expr) -> list[str]:
    """Return the lines after which a small deviation is a variable that isn't small."""
    plain = names.plain(name)
    lines = [f"{name} = {names.declared(name)}"]
    older = _made_before(names, {mark: names.small[mark]})
    if older:
        about = grouped(scalar_text(plain - names.small[mark], names), SUM + 1)
        lines.append(_in_all(older, f"{{sb.small({name}): {name} - {about}}}"))
    return lines


def _deviations(text: Writer, node: syntax.Expression) -> Iterator[tuple[str, str]]:
    """Return small variables, each with the text of the value from which it deviates, or nothing for zero."""
    if not isinstance(node, syntax.SetDisplay | syntax.ListDisplay):
        yield from ((identifier(each.name), "") for each in _variables(text, node))
        return
    for item in node.items:
        match item:
            case syntax.Infix(operator="=", left=left, right=right):
                yield _variable(text, left), text.text(right)
            case syntax.Call(function=syntax.Name(name="seq" | "op")):
                found = text.value(f"[{several(text, item)}]")
                yield from ((_declared(text.names, each), "") for each in _checked(found))
            case _ if not _is_small_anyway(text, item):
                yield _variable(text, item), ""


def _variables(text: Writer, node: syntax.Expression) -> Sequence[Expr]:
    return _checked(text.value(text.text(node)))


def _declared(names: Names, variable: Expr) -> str:
    """Return the identifier of a variable whose name is made by concatenation."""
    name = identifier(variable.name)
    if name not in names.symbols:
        names.functions |= {variable.name} if variable.kind == "time_function" else set()
        names.declare(variable.name)
    return name


def _checked(found: object) -> Sequence[Expr]:
    if not isinstance(found, list) or not all(isinstance(each, Expr) and each.is_variable for each in found):
        raise NoText("linear_modeling")
    return found


def _variable(text: Writer, node: syntax.Expression) -> str:
    """Return the name of a variable."""
    name = text.text(node)
    found = text.value(name)
    is_known = name.isidentifier() and isinstance(found, Expr) and name in text.names.symbols
    if not is_known or not (found.is_variable or small(text.names.plain(name)) in text.names.small):
        raise NoText("linear_modeling")
    return name


def _is_small_anyway(text: Writer, node: syntax.Expression) -> bool:
    """Whether an item is zero, or the derivative of a function of time, which is small with the function."""
    found = text.value(text.text(node))
    return found == 0 or (isinstance(found, Expr) and found.kind == "time_function" and bool(found.order))


def _deviation(names: Names, name: str, about: str) -> Expr:
    mark: Expr = small(names.plain(name))
    return mark + names.value(about) if about else mark


def _marked(name: str, about: str) -> str:
    return f"{grouped(about, SUM)} + sb.small({name})" if about else f"sb.small({name})"


def _made_before(names: Names, changes: Mapping[Expr, Expr]) -> list[str]:
    """Return the names of what holds variables that change; the variables are no part of it."""
    found = {name: value for name, value in names.values.items() if isinstance(value, _MARKED)}
    hidden = names.symbols.keys() | names.added - {names.master} | {"last", "__builtins__"}
    return [name for name, value in found.items() if name not in hidden and subs(value, changes) != value]


def _named(entering: Mapping[str, str], texts: Mapping[str, str]) -> list[str]:
    """Return the lines that give variables their marks, or take these from them."""
    plain = [name for name, about in entering.items() if not about]
    marked = [f"{', '.join(plain)} = sb.small({', '.join(plain)})"] if plain else []
    remarks = {
        name: f"  # results print the deviation as {name}" for name, about in entering.items() if about
    }
    others = [f"{name} = {made}{remarks.get(name, '')}" for name, made in texts.items() if name not in plain]
    return [*marked, *others]


def _changed(marks: str, texts: Mapping[str, str], older: Sequence[str]) -> list[str]:
    """Return the lines that also change what was made before."""
    names = list(texts)
    pairs = ", ".join(f"{name}: {made}" for name, made in texts.items())
    left = ", ".join(names) if len(names) > 1 else f"({names[0]},)"
    return [
        f"{marks} = {{{pairs}}}  # of what was made before, too",
        f"{left} = {marks}.values()",
        _in_all(older, marks),
    ]


def _in_all(older: Sequence[str], changes: str) -> str:
    """Return the line that substitutes in what was made before."""
    changed = ", ".join(older)
    listed = f"[{changed}]" if len(older) > 1 else changed
    return f"{changed} = sb.subs({listed}, {changes})"
