"""Commands that give numbers and pictures: roots, motions, curves; SciPy and Matplotlib say the same."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import SUM, grouped
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["NUMBERS"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _root(text: Writer, arguments: Arguments) -> str:
    """Return a root of one equation between two bounds, by Brent's method."""
    residual = _residual(text, arguments[0])
    variable, first, last = _range(text, arguments[1:])
    return f"scipy.optimize.brentq(sb.lambdify([{variable}], {residual}), {first}, {last})"


def _residual(text: Writer, node: syntax.Expression) -> str:
    before, text.as_differences = text.as_differences, True
    try:
        return text.text(node)
    finally:
        text.as_differences = before


def _range(text: Writer, arguments: Arguments) -> tuple[str, str, str]:
    """Return the variable of ``x = a..b``, and the bounds as numbers."""
    for argument in arguments:
        match argument:
            case syntax.Infix(
                operator="=", left=variable, right=syntax.Infix(operator="..", left=first, right=last)
            ):
                return text.text(variable), _float(text, first), _float(text, last)
    raise NoText("range")


def _float(text: Writer, node: syntax.Expression) -> str:
    written = text.text(node)
    found = text.value(written)
    if isinstance(found, int):
        return written
    if not isinstance(found, Expr) or not found.is_constant:
        raise NoText("number")
    return f"float({written})"


def _curve(method: str = "plot", spaced: str = "linspace") -> Call:
    """Return the writer of curves of an expression, or of several; ``method`` says which axes are logarithmic."""

    def write(text: Writer, arguments: Arguments) -> str:
        places, values = _samples(text, arguments, spaced)
        return f"plt.subplots()[1].{method}({places}, {values})"

    return write


def _samples(text: Writer, arguments: Arguments, spaced: str) -> tuple[str, str]:
    """Return the places of a range, and the values of what is drawn there."""
    variable, first, last = _range(text, arguments[1:])
    whole = text.text(arguments[0])
    places = f"np.{spaced}({first}, {last}, 200)"
    found = text.value(whole)
    if isinstance(found, list) and all(isinstance(each, Expr) for each in found):
        return places, f"np.transpose(sb.lambdify([{variable}], {whole})({places}))"
    if not isinstance(found, Expr):
        raise NoText("plot")
    return places, f"sb.lambdify([{variable}], {whole})({places})"


def _motion(text: Writer, arguments: Arguments) -> str:
    """Return the motion of differential equations with initial values, as ``dsolve(.., numeric)`` has it."""
    options = {str(getattr(each, "name", "")) for each in arguments} | {
        str(getattr(each.right, "name", "")) for each in arguments if isinstance(each, syntax.Infix)
    }
    if "numeric" not in options or not isinstance(arguments[0], syntax.SetDisplay):
        raise NoText("dsolve")
    equations, starts = [], []
    for each in arguments[0].items:
        initial = _initial(text, each)
        if initial:
            starts.append(initial)
        else:
            equations.append(_residual(text, each))
    functions = sorted(
        {
            leaf.name
            for each in equations
            for leaf in text.value(each).free_symbols
            if leaf.kind == "time_function"
        }
    )
    unknowns = ", ".join(
        text.text(
            syntax.Call(syntax.Name(each, place=arguments[0].place), (_TIME,), place=arguments[0].place)
        )
        for each in functions
    )
    listed = ", ".join(f"{grouped(each, SUM)}" for each in equations)
    return (
        f"sb.simulate(sb.equations_from_differential([{listed}], [{unknowns}]), "
        f"initial={{{', '.join(starts)}}}, t=(0, 10))"
    )


_TIME = syntax.Name("t", place=syntax.Place(1, 1, 1, 1))


def _initial(text: Writer, node: syntax.Expression) -> str:
    """Return the entry of an initial value, ``x(0) = 1`` or ``D(x)(0) = 1``; nothing for an equation."""
    match node:
        case syntax.Infix(
            operator="=",
            left=syntax.Call(function=syntax.Name() as name, arguments=(syntax.Integer(value=0),)),
            right=right,
        ):
            return f"{text.text(_of_time(name))}: {_float(text, right)}"
        case syntax.Infix(
            operator="=",
            left=syntax.Call(
                function=syntax.Call(function=syntax.Name(name="D"), arguments=(syntax.Name() as name,)),
                arguments=(syntax.Integer(value=0),),
            ),
            right=right,
        ):
            return f"sb.diff({text.text(_of_time(name))}, sb.t): {_float(text, right)}"
    return ""


def _of_time(name: syntax.Name) -> syntax.Call:
    return syntax.Call(name, (_TIME,), place=name.place)


def _motion_curve(text: Writer, arguments: Arguments) -> str:
    """Return the curve of expressions along a motion."""
    motion = text.text(arguments[0])
    axes = arguments[1] if len(arguments) > 1 else None
    if not isinstance(axes, syntax.ListDisplay) or len(axes.items) not in {2, 3}:
        raise NoText("odeplot")
    columns = ", ".join(f"{grouped(motion)}[{text.text(each)}]" for each in axes.items)
    if len(axes.items) == 3:
        return f'plt.figure().add_subplot(projection="3d").plot({columns})'
    return f"plt.subplots()[1].plot({columns})"


NUMBERS: Mapping[str, Call] = {
    "fsolve": _root,
    "plot": _curve(),
    "logplot": _curve("semilogy"),
    "semilogplot": _curve("semilogx", "geomspace"),
    "loglogplot": _curve("loglog", "geomspace"),
    "dsolve": _motion,
    "odeplot": _motion_curve,
}
"""Writers by the names of commands."""
