"""Rewriting: substitution, simplification, expansion, collection, coefficients."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial

from symbody.errors import ExpressionError, WorksheetError
from symbody.symbolic import Expr, combine_trig, expand_trig, number
from symbody.symbolic import collect as collected
from symbody.symbolic import expand as expanded
from symbody.symbolic import simplify as simplified
from symbody.symbolic.linear.elimination import eliminated, is_linear
from symbody.worksheet.builtins.substitution import substituted
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.entrywise import entrywise
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.mathematics.elimination import eliminated_in_turn
from symbody.worksheet.mathematics.inverse_functions import has_inverse, without_inverses
from symbody.worksheet.mathematics.order_term import without_order
from symbody.worksheet.mathematics.polynomial import coefficients, reduced
from symbody.worksheet.mathematics.positive_roots import with_positive_roots
from symbody.worksheet.mechanics.objects import refuse_object
from symbody.worksheet.printing.print import Style, text_of
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.structure import tree_of
from symbody.worksheet.values.value import (
    Array,
    Listed,
    MapleSet,
    Reference,
    Relation,
    Sequence,
    Table,
    Value,
)

__all__ = ["COMMANDS", "mapping_of"]


# --- substitution -----------------------------------------------------------------------------------------------------


def subs(session: Session, *arguments: Value) -> Value:
    """subs(x = a, .., e): one equation after the other; those of a list or a set at once.

    Of several solutions for the same unknowns, as solve returns them, the first one counts. The next ones find nothing
    to replace, unless an unknown has got its value meanwhile: this would be replaced by that of another solution.
    """
    if not arguments:
        raise WorksheetError("subs: no arguments; expected equations and an expression")
    *rules, value = arguments
    solutions: list[dict[Value, Value]] = []
    for rule in rules:
        mapping = mapping_of(session, rule)
        after = substituted(session, value, mapping)
        if not isinstance(rule, Relation):
            if any(mapping.keys() == each.keys() and mapping != each for each in solutions):
                if session.text(after) != session.text(value):
                    session.notice("subs: several solutions for the same unknowns; the first one is used")
                continue
            solutions.append(mapping)
        value = after
        if any(isinstance(new, Expr) and has_inverse(new) for new in mapping.values()):
            value = entrywise(session, value, without_inverses, keeps_value=True)
    return session.current(value)


def mapping_of(session: Session, rule: Value) -> dict[Value, Value]:
    """Return an equation, or a list or set of equations, as a mapping; the first of several for one name counts."""
    found = session.resolve(rule)
    if isinstance(found, Relation):
        return {_key(session, found.left): found.right}
    if isinstance(found, Table):
        return {key[0]: value for key, value in found.entries.items() if len(key) == 1}
    if isinstance(found, Array):
        items: tuple[Value, ...] = tuple(found.entries)
    elif isinstance(found, Listed | MapleSet | Sequence):
        items = found.items
    else:
        raise WorksheetError(
            f"subs: {session.text(rule)[:60]} is not an equation; expected one such as x = 1"
        )
    mapping: dict[Value, Value] = {}
    for item in items:
        for key, value in mapping_of(session, item).items():
            mapping.setdefault(key, value)
    return mapping


def _key(session: Session, value: Value) -> Value:
    return scalar(session, value) if isinstance(value, Expr | Reference) else value


def evaluated(session: Session, value: Value, *rules: Value) -> Value:
    """eval(e), eval(e, x = a), eval(e, {..}): full evaluation, at a point."""
    found = session.resolve(value)
    if rules and isinstance(rules[0], Expr):
        session.notice("eval(e, n): levels of evaluation are not counted; e is evaluated completely")
    if not rules or isinstance(rules[0], Expr):
        return session.current(found)
    return subs(session, *rules, session.current(found))


def unapply(session: Session, value: Value, *variables: Value) -> Value:
    """unapply(e, x, ..), unapply(e, [x, ..]): the operator (x, ..) -> e."""
    variables = tuple(
        item for each in variables for item in (each.items if isinstance(each, Listed) else (each,))
    )
    names = [each.name for each in variables if isinstance(each, Expr) and each.kind == "symbol"]
    if len(names) != len(variables):
        raise WorksheetError("unapply: expected names behind the expression")
    heading = names[0] if len(names) == 1 else f"({', '.join(names)})"
    return session.parsed(f"{heading} -> {text_of(value, Style(raw=frozenset(session.opaque)))}")


# --- simplification ---------------------------------------------------------------------------------------------------


def _simple(session: Session, value: Expr) -> Expr:
    session.limits.check()
    return simplified(without_inverses(value))


def simplify(session: Session, value: Value, *options: Value) -> Value:
    """simplify(e), simplify(e, trig), simplify(e, symbolic), simplify(e, relations, unknowns).

    A relation e stands for e = 0. By ``symbolic`` and ``assume = positive``, what stands under roots is positive.
    """
    place = next((i for i, each in enumerate(options) if side_relations(session, each)), None)
    if place is not None:
        unknowns = options[place + 1] if place + 1 < len(options) else None
        return _with_relations(session, value, side_relations(session, options[place]), unknowns)
    simple = entrywise(session, value, partial(_simple, session), keeps_value=True)
    if any(_is_word(each, "symbolic") or session.text(each) == "assume = positive" for each in options):
        return entrywise(session, simple, lambda each: _simple(session, with_positive_roots(each)))
    return simple


def side_relations(session: Session, value: Value) -> list[tuple[Expr, Expr]]:
    """Return the two sides of each relation of a list or set; those of an expression e are e and 0."""
    items = value.items if isinstance(value, Listed | MapleSet) else ()
    sides = ((each.left, each.right) if isinstance(each, Relation) else (each, number(0)) for each in items)
    return [(scalar(session, left), scalar(session, right)) for left, right in sides]


def _with_relations(
    session: Session, value: Value, relations: list[tuple[Expr, Expr]], unknowns: Value | None
) -> Value:
    """Relations that are linear in the unknowns are solved for them; others reduce polynomials."""
    names = (
        unknowns.items if isinstance(unknowns, Listed | MapleSet) else () if unknowns is None else (unknowns,)
    )
    wanted = [scalar(session, each) for each in names]
    if any(each.kind == "function" for each in wanted):
        return _with_relations_of_calls(session, value, relations, wanted)
    residuals = [left - right for left, right in relations]
    if wanted:
        solve = eliminated if is_linear(residuals, wanted) else eliminated_in_turn
        solution = solve(residuals, wanted)
        if solution is not None:
            changed = {old: new for old, new in solution.items() if new != old}
            return entrywise(session, value, lambda each: _simple(session, each.subs(changed)))

    def reduce(each: Expr) -> Expr:
        for left, right in relations:
            each = reduced(each, left, right, wanted)
        return _simple(session, each)

    return entrywise(session, value, reduce)


def _with_relations_of_calls(
    session: Session, value: Value, relations: list[tuple[Expr, Expr]], wanted: list[Expr]
) -> Value:
    """Relations in which functions such as cos(x) are unknowns: names stand for them while polynomials are reduced."""
    calls = {each: symbol(f"_call{i}") for i, each in enumerate(wanted) if each.kind == "function"}
    back = {name: call for call, name in calls.items()}
    named = [(left.subs(calls), right.subs(calls)) for left, right in relations]

    def reduce(each: Expr) -> Expr:
        found = each.subs(calls)
        for left, right in named:
            found = reduced(found, left, right, [each.subs(calls) for each in wanted])
        return _simple(session, found).subs(back)

    return entrywise(session, value, reduce)


def _rewriting(function: Callable[[Expr], Expr]) -> Command:
    def command(session: Session, value: Value, *options: Value) -> Value:
        def rewrite(each: Expr) -> Expr:
            session.limits.check()
            return function(each)

        return entrywise(session, value, rewrite, keeps_value=True)

    return command


def _expanded(value: Expr) -> Expr:
    try:
        return expand_trig(value)
    except ExpressionError:
        return expanded(value)


# --- polynomials ------------------------------------------------------------------------------------------------------


def collect(session: Session, value: Value, variables: Value, *forms: Value) -> Value:
    """collect(e, x [, form]): a polynomial in x; the form is a command for its coefficients."""
    items = variables.items if isinstance(variables, Listed | MapleSet | Sequence) else (variables,)
    names = [scalar(session, each) for each in items]
    commands = [each for each in forms if not _is_word(each, "distributed", "recursive")]

    def rewrite(each: Expr) -> Value:
        if commands:
            return _collected_with(session, each, names, commands[0])
        return collected(each, names)

    return entrywise(session, value, rewrite, keeps_value=True)


def _is_word(value: Value, *words: str) -> bool:
    return _named(value) and getattr(value, "name", "") in words


def _named(value: Value) -> bool:
    return isinstance(value, Reference) or (isinstance(value, Expr) and value.kind == "symbol")


def _collected_with(session: Session, value: Expr, names: list[Expr], form: Value) -> Value:
    if not names:
        return scalar(session, session.call(form, (value,)))
    total = number(0)
    for exponent, each in sorted(coefficients(value, names[0]).items(), reverse=True):
        inner = scalar(session, _collected_with(session, each, names[1:], form))
        total = total + inner * names[0] ** exponent
    return total


def coeff(session: Session, value: Value, variable: Value, power: Value | None = None) -> Value:
    """coeff(e, x, n), coeff(e, x^n): the coefficient of a power, by value."""
    by, exponent = scalar(session, variable), 1
    if power is not None:
        found = as_integer(power)
        if found is None:
            raise WorksheetError(f"coeff: the power {session.text(power)[:60]}; expected an integer")
        exponent = found
    elif tree_of(by).kind == "power" and (found := as_integer(tree_of(by).parts[1].value)) is not None:
        by, exponent = tree_of(by).parts[0].value, found

    def rewrite(each: Expr) -> Expr:
        found = coefficients(without_order(each), by)
        if any(part.has(by) for part in found.values()):
            session.notice(
                f"coeff: {session.text(each)[:60]} is no polynomial in {session.text(by)}; what else depends on it "
                "counts as known"
            )
        return found.get(exponent, number(0))

    refuse_object(session, "coeff", value)
    return entrywise(session, value, rewrite)


def coeffs(
    session: Session, value: Value, variables: Value | None = None, powers: Value | None = None
) -> Value:
    """coeffs(p, x), coeffs(p, [x, y], 't'): the coefficients that aren't zero; t becomes the products of powers."""
    expression = scalar(session, value)
    names = _variables(session, variables) or sorted(expression.free_symbols, key=str)
    found = [(expression, number(1))]
    for each in names:
        found = [
            (part, before * each**power)
            for whole, before in found
            for power, part in sorted(coefficients(whole, each).items())
        ]
    if powers is not None:
        name = powers.name if isinstance(powers, Expr) and powers.kind == "symbol" else None
        if name is None:
            raise WorksheetError(
                f"coeffs: {session.text(powers)[:60]} can't take the powers; expected a name"
            )
        session.give(name, sequence([power for _, power in found]))
    return sequence([part for part, _ in found])


def _variables(session: Session, given: Value | None) -> list[Expr]:
    """Return one variable, or those of a list or a set."""
    if given is None:
        return []
    items = given.items if isinstance(given, Listed | MapleSet) else (given,)
    return [scalar(session, each) for each in items]


def degree_of(session: Session, value: Value, variable: Value | None = None) -> Value:
    """degree(p, x), degree(p, {x, y}): FAIL for what is no polynomial in them; that of 0 is -infinity."""
    expression = expanded(scalar(session, value))
    names = _variables(session, variable) or sorted(expression.free_symbols, key=str)[:1]
    if expression.is_zero:
        return -symbol("infinity")
    parts = [(0, expression)]
    for each in names:
        parts = [
            (total + power, part)
            for total, whole in parts
            for power, part in coefficients(expanded(whole), each).items()
        ]
    if any(part.has(each) for _, part in parts for each in names):
        return symbol("FAIL")
    return number(max((total for total, _ in parts), default=0))


def _extreme(choose: Callable[[Iterable[int]], int], *, exponent: bool) -> Command:
    """Return the lowest or highest exponent of a polynomial, or its coefficient."""

    def command(session: Session, value: Value, variable: Value) -> Value:
        found = coefficients(expanded(scalar(session, value)), scalar(session, variable))
        if not found:
            return number(0)
        power = choose(found)
        return number(power) if exponent else found[power]

    return command


def _divided(dividend: Expr, divisor: Expr, x: Expr) -> tuple[Expr, Expr]:
    """Return the quotient and the remainder of polynomials in x."""
    rest, by = coefficients(expanded(dividend), x), coefficients(expanded(divisor), x)
    if not by:
        raise WorksheetError("quo, rem: division by zero")
    quotient, lead = number(0), max(by)
    while rest and max(rest) >= lead:
        power = max(rest)
        factor = rest[power] / by[lead]
        quotient = quotient + factor * x ** (power - lead)
        changed = {
            n: rest.get(n, number(0)) - factor * by.get(n - power + lead, number(0)) for n in range(power)
        }
        rest = {n: each for n, each in changed.items() if not each.is_zero}
    return quotient, sum((each * x**n for n, each in rest.items()), start=number(0))


def _division(*, remainder: bool) -> Command:
    """Return quo or rem: the quotient or the remainder of polynomials; a name behind them gets the other one."""

    def command(session: Session, value: Value, divisor: Value, variable: Value, *given: Value) -> Value:
        parts = _divided(scalar(session, value), scalar(session, divisor), scalar(session, variable))
        found, other = reversed(parts) if remainder else parts
        for name in given:
            if not isinstance(name, Expr) or name.kind != "symbol":
                raise WorksheetError(f"quo, rem: {session.text(name)[:60]}; expected a name in quotes")
            session.give(name.name, other)
        return found

    return command


def isolate(session: Session, equation: Value, unknown: Value) -> Value:
    """isolate(equation, x): the equation solved for x; of several solutions, the first one."""
    by = scalar(session, unknown)
    left, right = (equation.left, equation.right) if isinstance(equation, Relation) else (equation, number(0))
    residual = scalar(session, left) - scalar(session, right)
    solution = eliminated([residual], [by]) if is_linear([residual], [by]) else None
    if solution and by in solution:
        return Relation("=", by, solution[by])
    found = session.call(symbol("solve"), (residual, by))
    first = found.items[0] if isinstance(found, Sequence) and found.items else found
    if not isinstance(first, Expr) or first.has(by):
        raise WorksheetError(f"isolate: no solution for {session.text(by)} was found")
    if isinstance(found, Sequence):
        session.notice(f"isolate: {len(found.items)} solutions for {session.text(by)}; the first one is used")
    return Relation("=", by, first)


def algebraic_subs(session: Session, rule: Value, value: Value) -> Value:
    """algsubs(p = q, e): a polynomial p is replaced also inside longer sums and products."""
    if not isinstance(rule, Relation):
        raise WorksheetError("algsubs: expected an equation such as a*b = c")
    left, right = scalar(session, rule.left), scalar(session, rule.right)
    return entrywise(session, value, lambda each: reduced(each, left, right, []))


COMMANDS: dict[str, Command] = {
    "subs": subs,
    "algsubs": algebraic_subs,
    "eval": evaluated,
    "unapply": unapply,
    "simplify": simplify,
    "expand": _rewriting(_expanded),
    "combine": _rewriting(combine_trig),
    "radsimp": _rewriting(simplified),
    "rationalize": _rewriting(simplified),
    "collect": collect,
    "coeff": coeff,
    "coeffs": coeffs,
    "degree": degree_of,
    "ldegree": _extreme(min, exponent=True),
    "lcoeff": _extreme(max, exponent=False),
    "tcoeff": _extreme(min, exponent=False),
    "quo": _division(remainder=False),
    "rem": _division(remainder=True),
    "isolate": isolate,
}
