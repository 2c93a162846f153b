"""MBSymba: its commands by name, its global names, and what its packages print when they are loaded."""

from __future__ import annotations

import functools
import re
import warnings

from symbody.errors import ModelNotice
from symbody.symbolic import number, symbol
from symbody.worksheet.commands import (
    bodies,
    display,
    equations,
    frames,
    joints,
    kinematics,
    master_frame,
    state_space,
    tyres,
)
from symbody.worksheet.commands.arguments import check_arguments
from symbody.worksheet.commands.signatures import SIGNATURES
from symbody.worksheet.evaluation.derivative_rules import with_rules
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mechanics.modes import Mechanics, mechanics
from symbody.worksheet.mechanics.small_variables import linear_modeling, linearize
from symbody.worksheet.values.value import Boolean, MapleSet, Reference, String, Table, Value

__all__ = ["COMMANDS", "describe", "install", "load"]


def GetLicenseStatus(session: Session) -> Value:
    """GetLicenseStatus(): a table with StatusCode 0 and a Message: no licence is needed here."""
    del session
    return Table(
        {
            (symbol("StatusCode"),): number(0),
            (symbol("Message"),): String("symbody needs no licence"),
        }
    )


_TABLE: dict[str, Command] = {
    **frames.COMMANDS,
    **kinematics.COMMANDS,
    **bodies.COMMANDS,
    **equations.COMMANDS,
    **state_space.COMMANDS,
    **joints.COMMANDS,
    **tyres.COMMANDS,
    **display.COMMANDS,
    **master_frame.COMMANDS,
    "linear_modeling": linear_modeling,
    "linearize": linearize,
    "GetLicenseStatus": GetLicenseStatus,
}


def _noting(name: str, command: Command) -> Command:
    """Return a command that refuses wrong arguments, and follows the sheet's own rules of derivatives.

    Its notices about the model go to the session.
    """

    @functools.wraps(command)
    def noted(session: Session, *arguments: Value) -> Value:
        check_arguments(session, name, arguments)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", ModelNotice)
            result = command(session, *arguments)
        session.notices += [str(each.message) for each in caught]
        return with_rules(session, result)

    return noted


COMMANDS: dict[str, Command] = {name: _noting(name, command) for name, command in _TABLE.items()}
"""The commands of MBSymba by name."""


def describe(name: str) -> str | None:
    """Return what Describe prints of a command: what it returns, and how it is declared or called."""
    command = COMMANDS.get(name)
    if command is None:
        return None
    call, _, meaning = (command.__doc__ or "").split("\n")[0].partition(": ")
    if name in SIGNATURES:
        _, _, other = call.partition(" or ")
        lines = [f"# {meaning}", f"# Or {other}."] if other else [f"# {meaning}"]
        return "\n".join([*lines, f"{name}{SIGNATURES[name]}"])
    return f"# {meaning}\n{name}{call[call.find('(') :]}" if "(" in call else f"# {meaning}\n{name}"


def install(session: Session) -> None:
    """Begin a session, or begin it again: the global names of MBSymba, and no modes."""
    session.mechanics = Mechanics()
    master_frame.name_ground(session)
    session.names |= {
        "_gravity": _null_vector(session),
        "omegaMV": _null_vector(session),
        "small_vars": MapleSet(()),
        "dependent_coordinates": Boolean(False),
        "mframe_flag": Boolean(False),
    }


def _null_vector(session: Session) -> Value:
    return kinematics.make_VECTOR(session, Reference("ground"), number(0), number(0), number(0))


_PACKAGE = re.compile(r"mbsymba(?:_r(?P<release>\d)(?P<minor>[._]\d)?)?(?P<part>_\w+)?", re.IGNORECASE)
_NONLINEAR = "Warning, Non-Linear Modeling option has been choosen"
_BANNERS = {
    4: (
        "MBSymba release 4.1 - Copyright (C) 2006 - by Roberto.Lot@unipd.it & Matteo.Massaro@unipd.it",
        _NONLINEAR,
    ),
    5: (
        "MBSymba release 5.1 - Copyright (C) 2009 - by Roberto.Lot@unipd.it & Matteo.Massaro@unipd.it",
        _NONLINEAR,
    ),
    6: (
        "MBSymba release 6 - Copyright (C) 2011 by R. Lot, M. Massaro - University of Padova (Italy)",
        "Warning, these protected names have been redefined and unprotected: *, +, -, union",
    ),
}


def load(session: Session, name: str) -> bool:
    """Load a package of MBSymba: its release is a mode. Return whether the name is one of its packages."""
    found = _PACKAGE.fullmatch(name)
    if found is None:
        return False
    release = int(found["release"] or 3)
    modes = mechanics(session)
    if modes.release != release:
        modes.release = release
        if modes.moving is None:
            master_frame.name_ground(session)
    if not found["part"]:
        session.lines += _BANNERS.get(release, ())
    return True
