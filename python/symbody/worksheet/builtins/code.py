"""Code: operation counts, computation sequences, MATLAB, C, Fortran, Python."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number
from symbody.worksheet.builtins.arrays import array_of
from symbody.worksheet.builtins.files import output_path
from symbody.worksheet.builtins.texts import unparsed
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.entrywise import parts_of
from symbody.worksheet.evaluation.session import Command, Session, sequence
from symbody.worksheet.mathematics.operation_count import operation_count
from symbody.worksheet.mathematics.shared_parts import computation_sequence, named_parts
from symbody.worksheet.printing.code_text import (
    LANGUAGES,
    MATLAB,
    Language,
    code_name,
    code_text,
    entry_name,
    statement_text,
)
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Listed,
    MapleSet,
    ProcedureValue,
    Reference,
    Relation,
    Sequence,
    String,
    Table,
    Unevaluated,
    Value,
)

__all__ = ["COMMANDS", "PACKAGES"]

_COUNTED = ("multiplications", "additions", "subscripts", "divisions", "functions", "assignments")
"""The order in which counts are printed."""


def _right_side(session: Session, relation: Relation) -> Expr:
    """Return the value that an equation gives its left side; an inequality gives none."""
    if relation.operator != "=":
        raise WorksheetError(
            f"codegen: {session.text(relation)[:60]} is a condition; expected an expression, or an equation name = e"
        )
    return scalar(session, session.current(relation.right))


def _scalars(session: Session, value: Value) -> list[Expr]:
    found = session.resolve(value)
    if isinstance(found, Relation):
        return [scalar(session, session.current(found.right))]
    if isinstance(found, Array):
        return [each for entry in found.entries for each in _scalars(session, session.current(entry))]
    if isinstance(found, Table):
        return [
            each for entry in found.entries.values() for each in _scalars(session, session.current(entry))
        ]
    if parts_of(found):
        return [each for part in parts_of(found) for each in _scalars(session, part)]
    if isinstance(found, Listed | MapleSet | Sequence):
        return []
    return [scalar(session, session.current(value))]


def cost(session: Session, *values: Value) -> Value:
    """cost(e, ..): operations of an evaluation; of a computation sequence with its assignments."""
    total: Counter[str] = Counter()
    for given in values:
        value = _value_of(session, given)
        found = session.resolve(value)
        items = parts_of(found) if isinstance(found, Listed | MapleSet) else (found,)
        total["assignments"] += sum(isinstance(item, Relation) for item in items)
        total.update(operation_count(_scalars(session, value)))
    terms: tuple[Value, ...] = tuple(number(total[name]) * symbol(name) for name in _COUNTED if total[name])
    if len(terms) < 2:
        return terms[0] if terms else number(0)
    return Unevaluated(symbol("+"), terms)


def optimize(session: Session, *values: Value) -> Value:
    """optimize(e): a computation sequence: names t1, t2, .. of parts that occur several times, then the results."""
    if values and isinstance(session.resolve(values[0]), ProcedureValue):
        made = optimize(session, _value_of(session, values[0]), *values[1:])
        return made_procedure(session, made, Listed(_parameters(session, values[0])))
    results: list[tuple[Value | None, Expr]] = []
    for value in values:
        found = session.resolve(value)
        if isinstance(found, Relation) and getattr(found.left, "name", "") in ("tryhard", "precision"):
            continue
        if isinstance(found, Expr) and found.kind == "symbol" and found.name == "tryhard":
            continue
        results.extend(_results(session, found))
    equations: list[Value] = []
    left = iter(results)
    names = [None if name is None else unparsed(session, name) for name, _ in results]
    steps = computation_sequence(names, [each for _, each in results])
    count = sum(part is not None for part, _ in steps)
    for part, expression in steps:
        name = part if part is not None else next(left)[0]
        count += name is None
        equations.append(Relation("=", symbol(f"t{count}") if name is None else name, expression))
    return sequence(equations)


def made_procedure(session: Session, value: Value, parameters: Value) -> Value:
    """makeproc(e, [x, y]), makeproc([t1 = e, ..], [x, y]): a procedure of an expression or a computation sequence."""
    parts = parts_of(value) if isinstance(value, Listed | Sequence) else ()
    items = parts if any(isinstance(each, Relation) for each in parts) else (value,)
    inner = [unparsed(session, each) for each in parts_of(parameters)]
    lefts = [unparsed(session, each.left) for each in items if isinstance(each, Relation)]
    held = f"local {', '.join(dict.fromkeys(lefts))}; " if lefts else ""
    steps = [
        f"{unparsed(session, each.left)} := {unparsed(session, each.right)}"
        if isinstance(each, Relation)
        else unparsed(session, each)
        for each in items
    ]
    return session.parsed(f"proc ({', '.join(inner)}) {held}{'; '.join(steps)} end proc")


def _results(session: Session, value: Value) -> list[tuple[Value | None, Expr]]:
    if isinstance(value, Relation):
        return [(value.left, scalar(session, value.right))]
    if isinstance(value, Array):
        return [(None, scalar(session, session.current(each))) for each in value.entries]
    if isinstance(value, Listed | MapleSet | Sequence):
        return [each for item in value.items for each in _results(session, item)]
    return [(None, scalar(session, value))]


def _names(expressions: list[Expr]) -> frozenset[str]:
    return frozenset(each.name for expression in expressions for each in expression.free_symbols)


# --- MATLAB -----------------------------------------------------------------------------------------------------------


def matlab(session: Session, value: Value, *options: Value) -> Value:
    """CodeGeneration[Matlab](e, optimize, output = string, resultname = "r"): e as MATLAB statements."""

    def lines(name: str, shares: bool) -> list[str]:  # noqa: FBT001 - as _generated calls it
        if isinstance(session.resolve(value), ProcedureValue):
            return _function_lines(session, value, shares=shares)
        return _lines(session, value, name, shares=shares)

    return _generated(session, options, lines, "CodeGeneration[Matlab]")


def _function_lines(session: Session, value: Value, *, shares: bool) -> list[str]:
    """Return a procedure as a function of MATLAB, by its value for symbols."""
    name = code_name(value.name, MATLAB) if isinstance(value, Reference) else "cg"
    names = ", ".join(code_name(str(each), MATLAB) for each in _parameters(session, value))
    body = _lines(session, _value_of(session, value), f"{name}return", shares=shares)
    return [f"function {name}return = {name}({names})", *(f"  {line}" for line in body)]


def _parameters(session: Session, procedure: Value) -> tuple[Value, ...]:
    """Return the parameters of a procedure as symbols.

    Raises:
        WorksheetError: one is a name that has a value in the sheet, which would be taken for it.
    """
    found = session.resolve(procedure)
    assert isinstance(found, ProcedureValue)
    names = [each.name for each in found.definition.parameters]
    held = next((each for each in names if each in session.names), None)
    if held is not None:
        raise WorksheetError(
            f"codegen: the parameter {held} is a name that has a value; expected one without: unassign('{held}')"
        )
    return tuple(symbol(each) for each in names)


def _value_of(session: Session, value: Value) -> Value:
    """Return what a procedure gives for symbols; any other value as it is."""
    if not isinstance(session.resolve(value), ProcedureValue):
        return value
    return session.call(value, _parameters(session, value))


def _generated(
    session: Session,
    options: tuple[Value, ...],
    lines: Callable[[str, bool], list[str]],
    command: str,
    name: str = "cg",
) -> Value:
    """Print the lines of a program, or return or write them, as the options say.

    Args:
        session: the session.
        options: names, and equations of a name and a value.
        lines: makes the lines, of the name of the result and of whether parts are shared.
        command: what messages call the command.
        name: the name of a result that has none.
    """
    settings = {unparsed(session, each.left): each.right for each in options if isinstance(each, Relation)}
    words = {unparsed(session, each) for each in options if not isinstance(each, Relation)}
    shares = bool(words & {"optimize", "optimized"})
    shares = shares or ("optimize" in settings and unparsed(session, settings["optimize"]) != "false")
    for each in settings.keys() - _OPTIONS:
        session.notice(f"{command}: the option {each} is not known and is left out")
    name = unparsed(session, settings["resultname"]) if "resultname" in settings else name
    text = "".join(f"{line}\n" for line in lines(name, shares))
    target = settings.get("output", settings.get("filename"))
    if target is None:
        session.print(text.rstrip("\n"))
        return NULL
    if unparsed(session, target) == "string":
        return String(text)
    with output_path(session, target).open("a", encoding="utf-8") as file:
        file.write(text)
    return NULL


_OPTIONS = {
    *("optimize", "output", "resultname", "declare", "precision", "coercetypes", "defaulttype", "mode"),
    *("reduceanalysis", "filename", "deducetypes", "functionprecision"),
}


def _lines(session: Session, value: Value, name: str, *, shares: bool) -> list[str]:
    found = _by_rows(session, session.resolve(value))
    if isinstance(found, Array):
        return _matrix_lines(session, found, name, shares=shares)
    if isinstance(found, Listed | MapleSet):
        items = found.items
        if items and all(isinstance(each, Relation) for each in items):
            return _assignment_lines(
                session, [each for each in items if isinstance(each, Relation)], shares=shares
            )
        return _matrix_lines(session, Array(1, len(items), list(items), "RowVector"), name, shares=shares)
    if isinstance(found, Relation):
        return _assignment_lines(session, [found], shares=shares)
    if not isinstance(found, Expr):
        raise WorksheetError(
            f"CodeGeneration[Matlab]: {session.text(value)[:60]} is no expression and no matrix"
        )
    return _assignment_lines(session, [Relation("=", symbol(name), found)], shares=shares)


def _by_rows(session: Session, value: Value) -> Value:
    """Return a list of lists as a matrix."""
    is_matrix = isinstance(value, Listed) and value.items and isinstance(value.items[0], Listed)
    return array_of(session, value, "CodeGeneration") if is_matrix else value


def _assignment_lines(session: Session, equations: list[Relation], *, shares: bool) -> list[str]:
    lefts = [code_name(unparsed(session, each.left), MATLAB) for each in equations]
    rights = [_right_side(session, each) for each in equations]
    if not shares:
        return [f"{left} = {code_text(right)};" for left, right in zip(lefts, rights, strict=True)]
    results = iter(lefts)
    steps = computation_sequence(lefts, rights, frozenset(lefts))
    return [
        f"{next(results) if part is None else code_text(part)} = {code_text(right)};" for part, right in steps
    ]


def _matrix_lines(session: Session, array: Array, name: str, *, shares: bool) -> list[str]:
    entries = [scalar(session, session.current(each)) for each in array.entries]
    lines: list[str] = []
    if shares:
        definitions, entries = named_parts(entries, _names(entries) | {name})
        lines = [f"{code_text(left)} = {code_text(right)};" for left, right in definitions]
    texts = [code_text(each) for each in entries]
    rows = [
        " ".join(_spaceless(text) for text in texts[i * array.columns : (i + 1) * array.columns])
        for i in range(array.rows)
    ]
    return [*lines, f"{code_name(name, MATLAB)} = [{'; '.join(rows)};];"]


def _spaceless(text: str) -> str:
    """Within brackets, MATLAB takes a blank before a sign for the end of an entry."""
    return text.replace(" ", "")


# --- other languages --------------------------------------------------------------------------------------------------


def _in(language: Language, name: str) -> Command:
    """Return the command that writes a language; ``name`` begins the names of results that have none."""

    def generate(session: Session, value: Value, *options: Value) -> Value:
        return _generated(
            session,
            options,
            lambda given, shares: _program(session, value, given, language, shares=shares),
            "codegen",
            name,
        )

    generate.__doc__ = 'C(e, optimize, output = string, resultname = "r"): e as statements of a program.'
    return generate


def _program(session: Session, value: Value, name: str, language: Language, *, shares: bool) -> list[str]:
    """Return the lines of a program.

    Args:
        session: the session.
        value: what it computes.
        name: the name of a result that has none.
        language: the language.
        shares: whether parts that occur several times get names.
    """
    if language is LANGUAGES["C"] and isinstance(session.resolve(value), ProcedureValue):
        return _c_function(session, value, shares=shares)
    results = list(_named_results(session, _by_rows(session, session.resolve(value)), name, language))
    names, rights = [name for name, _ in results], [right for _, right in results]
    lines: list[str] = []
    if shares:
        definitions, rights = named_parts(rights, _names(rights) | frozenset(names))
        lines = [statement_text(code_text(left, language), right, language) for left, right in definitions]
    return [
        *lines,
        *(statement_text(left, right, language) for left, right in zip(names, rights, strict=True)),
    ]


def _c_function(session: Session, value: Value, *, shares: bool) -> list[str]:
    """Return a procedure as a function of C, by its value for symbols."""
    language = LANGUAGES["C"]
    name = code_name(value.name, language) if isinstance(value, Reference) else "cg"
    inner = ", ".join(f"double {code_name(str(each), language)}" for each in _parameters(session, value))
    result = scalar(session, _value_of(session, value))
    definitions, results = named_parts([result], _names([result])) if shares else ([], [result])
    parts = [code_text(left, language) for left, _ in definitions]
    lines = [f"double {', '.join(parts)};"] if parts else []
    lines += [
        statement_text(part, right, language) for part, (_, right) in zip(parts, definitions, strict=True)
    ]
    lines.append(f"return({code_text(results[0], language)});")
    return [f"double {name} ({inner})", "{", *(f"  {line}" for line in lines), "}"]


def _named_results(
    session: Session, value: Value, name: str, language: Language
) -> Iterator[tuple[str, Expr]]:
    """Return what a program computes: equations by their left sides, entries of arrays, an expression."""
    if isinstance(value, Relation):
        right = _right_side(session, value)
        yield code_name(unparsed(session, value.left), language), right
    elif isinstance(value, Array):
        for place, entry in enumerate(value.entries):
            row, column = divmod(place, value.columns)
            indices = (row,) if value.columns == 1 else (column,) if value.rows == 1 else (row, column)
            yield (
                entry_name(code_name(name, language), indices, language),
                scalar(session, session.current(entry)),
            )
    elif isinstance(value, Listed | MapleSet):
        for place, item in enumerate(value.items):
            if isinstance(item, Relation):
                yield from _named_results(session, item, name, language)
            else:
                yield (
                    entry_name(code_name(name, language), (place,), language),
                    scalar(session, session.current(item)),
                )
    else:
        yield code_name(name, language), scalar(session, session.current(value))


COMMANDS: dict[str, Command] = {}

PACKAGES: dict[str, dict[str, Command]] = {
    "codegen": {
        "cost": cost,
        "optimize": optimize,
        "makeproc": made_procedure,
        "C": _in(LANGUAGES["C"], "t0"),
        "fortran": _in(LANGUAGES["Fortran"], "t0"),
    },
    "CodeGeneration": {"Matlab": matlab, **{name: _in(each, "cg") for name, each in LANGUAGES.items()}},
}
