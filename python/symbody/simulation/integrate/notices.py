"""Notices: what a user should know of an integrated motion."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import nan

import numpy as np

from symbody.multibody.named_constraint import named_constraints, redundant
from symbody.multibody.shared_multiplier import HOW_TO_SHARE
from symbody.simulation.constraint.consistent_position import term_sizes
from symbody.simulation.constraint.dependent_constraints import dependent_constraints, named_dependence
from symbody.simulation.constraint.kinematics import kinematics_in
from symbody.simulation.constraint.lost_independence import lost_independence
from symbody.simulation.constraint.singular_kinematics import another_choice, singular_kinematics
from symbody.simulation.constraint.singular_passage import singular_passages
from symbody.simulation.constraint.singular_position import SINGULAR, is_singular, may_be_singular
from symbody.simulation.model.model import Model
from symbody.symbolic.numeric.deficiency import Deficiency, strongest

from .half_turn import half_turns
from .integrated import Integrated
from .joint_limit import passed_limits, strange_limits, unknown_limits
from .kinematics_at import kinematics_at
from .methods import DEFAULT, methods_that
from .missed_contact import missed_contacts
from .negative_size import negative_sizes
from .opened_constraint import LEFT, opened_constraints
from .outcome import FailureKind
from .pole_at_start import pole_at_start

__all__ = [
    "OVERCONSTRAINED",
    "ROWS",
    "Finding",
    "deficiency_findings",
    "findings_of",
    "notices_of_motion",
    "sentence",
]


OVERCONSTRAINED = "overconstrained"
"""The kind of the finding that redundant constraints were left out."""


@dataclass(frozen=True, order=True)
class Finding:
    """A fact that the user of a motion should know.

    Attributes:
        kind: a key of `ROWS`.
        subject: its subject, in the user's names; cases with the same subject are reported together.
        size: its severity, if that is a number: of many cases, the worst one is reported.
        t: the instant since when it holds, in s, if it is known.
    """

    kind: str
    subject: str = ""
    size: float = nan
    t: float = nan


@dataclass(frozen=True)
class _Row:
    """A kind of finding.

    Attributes:
        find: returns the findings of this kind in a motion.
        sentence: the message, with ``{subject}``, ``{size}`` and ``{t}``.
    """

    find: Callable[[Integrated], Iterable[Finding]]
    sentence: str


def _stiffness(motion: Integrated) -> Iterable[Finding]:
    outcome = motion.outcome
    return [Finding("stiff")] if outcome.statistics.is_stiff and outcome.failure is None else []


def _deficiencies(motion: Integrated) -> Iterable[Finding]:
    return deficiency_findings(motion.outcome.deficiencies, motion.task.model)


def _imbalance(motion: Integrated) -> Iterable[Finding]:
    found, failure = motion.outcome.imbalance, motion.outcome.failure
    # A motion that diverges takes its energy with it.
    is_failed = failure is not None and failure.kind is not FailureKind.INTERRUPTED
    return (
        []
        if found is None or is_failed
        else [Finding("imbalance", _better_way(motion), size=found[1], t=found[0])]
    )


def _better_way(motion: Integrated) -> str:
    """Return what may improve the energy balance of a motion."""
    task = motion.task
    if task.method.is_explicit and not task.trail:
        return "use smaller tolerances or a smaller max_step, or begin at another position"
    projected = " with constraints='projection'" if task.model.constraints else ""
    return f"use smaller tolerances, or method={DEFAULT!r}{projected}"


def _redundancy(motion: Integrated) -> Iterable[Finding]:
    """Return which constraints were left out, and from which others they follow."""
    found = motion.task.redundancy
    if found is None:
        return []
    others = [row for row in found.rows if row not in found.choice]
    told = redundant(found.conditions, found.choice, others, "wherever it moves")
    verb = "are" if found.count > 1 else "is"
    shared = f"; {_SHARED}" if others else ""
    return [Finding(OVERCONSTRAINED, f"{told}, and {verb} left out{shared}")]


_SHARED = (
    "rigid bodies don't determine how redundant constraints share a load: multipliers of minimum norm are given, "
    f"{HOW_TO_SHARE}"
)


def _singular_start(motion: Integrated) -> Iterable[Finding]:
    """Return which constraints are dependent at the initial position, but not at neighbouring positions."""
    model = motion.task.model
    state = motion.outcome.states[0][: len(model.state)]
    if not model.constraints:
        return []
    kinematics, p = kinematics_at(model, motion.parameters, state)
    t, q = float(motion.task.instants[0]), state[: len(model.coordinates)]
    if not may_be_singular(kinematics, p, t, q, model.independent_constraints):
        return []
    values = np.array([motion.parameters[name] for name in (*model.parameters, *model.damping)])
    named = named_dependence(dependent_constraints(model, values, t, state, SINGULAR))
    return [Finding("start", named)] if named and is_singular(kinematics, p, t, q) else []


def _singular_kinematics(motion: Integrated) -> Iterable[Finding]:
    """Return which speeds and rates hardly determine each other at the initial position."""
    model = motion.task.model
    if not model.system.has_quasi_velocities:
        return []
    state = motion.outcome.states[0][: len(model.state)]
    kinematics, p = kinematics_at(model, motion.parameters, state)
    t, q = float(motion.task.instants[0]), state[: len(model.coordinates)]
    found = singular_kinematics(kinematics, p, t, q)
    return [Finding("kinematics", f"{found}; {another_choice(kinematics)}")] if found else []


def _poles(motion: Integrated) -> Iterable[Finding]:
    """Return the accelerations that rounding decides at the initial state."""
    model = motion.task.model
    values = np.array([motion.parameters[name] for name in (*model.parameters, *model.damping)])
    state = np.array(motion.outcome.states[0][: len(model.state)])
    found = pole_at_start(model, values, float(motion.task.instants[0]), state)
    return [Finding("pole", found)] if found else []


def _passages(motion: Integrated) -> Iterable[Finding]:
    """Return the singular positions that were passed, if the method does not keep the motion on its branch."""
    passed = singular_passages(motion.task.model, motion.parameters, motion.outcome.trail)
    return [Finding("passage", size=float(len(passed)), t=float(passed[0]))] if len(passed) else []


def _lost_independence(motion: Integrated) -> Iterable[Finding]:
    """Return where the independent speeds of embedded equations do not determine the others."""
    at, named = lost_independence(motion.task.model, motion.parameters, motion.outcome.trail)
    return [Finding("dependent", named, size=float(len(at)), t=float(at[0]))] if len(at) else []


def _uncertainty(motion: Integrated) -> Iterable[Finding]:
    t = motion.outcome.uncertain
    return [] if t is None else [Finding("uncertain", t=t)]


def _violations(motion: Integrated) -> Iterable[Finding]:
    """Return the constraint with the largest violation, if a motion has left its constraints at its end."""
    model = motion.task.model
    return _left(motion, "violation") if model.position_constraints else []


def _openings(motion: Integrated) -> Iterable[Finding]:
    """Return the constraints that were left out as redundant, and that the motion does not keep."""
    return [
        Finding("opened", f"constraint {each.name}", each.size, each.t) for each in opened_constraints(motion)
    ]


def _departures(motion: Integrated) -> Iterable[Finding]:
    """Return the same of constraints that were eliminated, which nothing enforces."""
    return _left(motion, "departure") if motion.task.model.system.eliminated_constraints else []


def _left(motion: Integrated, kind: str) -> Iterable[Finding]:
    model, outcome = motion.task.model, motion.outcome
    system = model.system.whole
    if outcome.failure is not None or not system.position_constraints:
        return []
    kinematics = kinematics_in(system, dict(model.inputs))
    p = np.array([motion.parameters[name] for name in kinematics.parameters])
    q = np.array(outcome.end[1][: len(model.coordinates)])
    with np.errstate(all="ignore"):
        phi, phi_q, sizes = kinematics.position(outcome.end[0], q, p)
        off = np.abs(phi) / term_sizes(q, phi_q, sizes)
    left_out = model.system.left_out
    off[[k for k, place in enumerate(system.holonomic) if system.multipliers[place] in left_out]] = 0.0
    worst = int(np.argmax(off))
    if not off[worst] > LEFT:
        return []
    (name,) = named_constraints(system.conditions, [system.holonomic[worst]])
    return [Finding(kind, f"constraint {name}", float(off[worst]))]


def _limits(motion: Integrated) -> Iterable[Finding]:
    """Return the joints that are beyond their limits at some instant."""
    return [Finding("limit", each.joint, each.size, each.t) for each in passed_limits(motion)]


def _unknown_limits(motion: Integrated) -> Iterable[Finding]:
    return [Finding("unlimited", subject) for subject in unknown_limits(motion)]


def _strange_limits(motion: Integrated) -> Iterable[Finding]:
    return [Finding("limits", f"{joint} {fault}") for joint, fault in strange_limits(motion)]


def _half_turns(motion: Integrated) -> Iterable[Finding]:
    return [Finding("half turn", each.load, t=each.t) for each in half_turns(motion)]


def _negative_sizes(motion: Integrated) -> Iterable[Finding]:
    return [
        Finding("negative", f"{each.name} of {each.load}", each.depth, each.t)
        for each in negative_sizes(motion)
    ]


def _missed_contacts(motion: Integrated) -> Iterable[Finding]:
    return [Finding("missed", each.load, each.depth, each.t) for each in missed_contacts(motion)]


def _jumps(motion: Integrated) -> Iterable[Finding]:
    found = motion.outcome.sensitivities
    return [] if found is None or found.jump is None else [Finding("jump", found.jump[1], t=found.jump[0])]


def _left_by_device(motion: Integrated) -> Iterable[Finding]:
    """Return why a device did not integrate a motion; a failure says more."""
    outcome = motion.outcome
    return [Finding("left", outcome.left)] if outcome.left and outcome.failure is None else []


ROWS: dict[str, _Row] = {
    "deficient": _Row(_deficiencies, "{subject}"),
    OVERCONSTRAINED: _Row(
        _redundancy,
        "the mechanism is overconstrained: {subject}",
    ),
    "start": _Row(
        _singular_start,
        "the motion starts at a singular position, from which several motions may continue: {subject}, but not at "
        "neighbouring positions; start at another position of the intended motion, or check that this is the "
        "intended one",
    ),
    "kinematics": _Row(
        _singular_kinematics,
        "the kinematics are ill-conditioned where the motion starts, so that rounding errors may decide it: {subject}",
    ),
    "pole": _Row(
        _poles,
        "the motion starts where {subject}, which decide it; begin at another position, or choose coordinates that are "
        "regular there, such as other Euler angles, or quaternion=True of a joint",
    ),
    "violation": _Row(
        _violations,
        "the motion has left its constraints: at its end {subject} is off by {size:.1g} of the magnitude of its "
        "terms; use smaller tolerances or another way to enforce them (constraints=...), and leave out those that "
        "follow from others",
    ),
    "opened": _Row(
        _openings,
        "{subject}, which was left out because it follows from the others where the motion begins, does not hold from "
        "t = {t:.6g} s on: it is off by up to {size:.1g} of the magnitude of its terms, so that the mechanism has come "
        "apart and the motion is wrong from there; "
        f"use method={' or '.join(methods_that(lambda method: method.keeps_branch))} with constraints='projection', "
        "which stays on its branch, or end the motion by an event before",
    ),
    "departure": _Row(
        _departures,
        "the motion has left constraints that were eliminated: at its end {subject} is off by {size:.1g} of the "
        "magnitude of its terms; use smaller tolerances, or simulate the equations with multipliers, which are kept",
    ),
    "imbalance": _Row(
        _imbalance,
        "the energy balance, including work, is off by {size:.1g} of the largest energy that varies, more than the "
        "tolerances explain, from t = {t:.6g} s on or slightly earlier; {subject}, and look for a force that jumps "
        "or a singular position there",
    ),
    "passage": _Row(
        _passages,
        "the motion passes singular positions ({size:.0f}, the first at about t = {t:.4g} s), where the constraints "
        "depend on each other and branches meet; it may have changed its branch there: only method="
        f"{' or '.join(methods_that(lambda method: method.keeps_branch))} with constraints='projection' prevent this",
    ),
    "dependent": _Row(
        _lost_independence,
        "the motion passes positions ({size:.0f}, the first at about t = {t:.4g} s) at which {subject}: the embedded "
        "equations divide by zero there, and the motion is less accurate afterwards than its tolerances; choose other "
        "independent speeds, embedded(..., independent=[...]), or simulate the equations with multipliers",
    ),
    "uncertain": _Row(
        _uncertainty,
        "at t = {t:.6g} s the motion is so close to a singular position of its constraints that rounding errors decide "
        "on which branch it continues; compare it with a motion with another tolerance or max_step, or from a "
        "slightly different initial state",
    ),
    "limit": _Row(
        _limits,
        "{subject} is beyond its limit by up to {size:.3g}, first at t = {t:.6g} s: limits exert no forces; end the "
        "motion there with events=stops(equations), begin inside, or model the stop as a load",
    ),
    "unlimited": _Row(
        _unknown_limits,
        "the limits of {subject}, which has no value, and were not checked; give it among the parameters",
    ),
    "limits": _Row(_strange_limits, "the limits of {subject}"),
    "half turn": _Row(
        _half_turns,
        "{subject} is turned by more than half a turn from its free angle, first at about t = {t:.4g} s, where its "
        "torque changes to the other side: its joint closes a loop, and its angle is known from -pi to pi only; make "
        "the spring with all_turns=True, or let another joint close the loop by loop=True",
    ),
    "negative": _Row(
        _negative_sizes,
        "{subject} is negative, down to -{size:.3g}, first at t = {t:.6g} s; expected a size or a resistance that is "
        "never negative; for a law that feeds energy in, use line_force or motor",
    ),
    "missed": _Row(
        _missed_contacts,
        "{subject} is passed without its force at about t = {t:.6g} s, by up to {size:.3g} m: the contact begins and "
        "ends within a step; give max_step, a fraction of the duration of the contact",
    ),
    "jump": _Row(
        _jumps,
        "the rates jump at t = {t:.6g} s, where {subject} passes zero, and the sensitivities jump there, too: after it "
        "they are not known, NaN; replace the jump by a smooth law, such as tanh(v/v0) for sign(v)",
    ),
    "left": _Row(
        _left_by_device,
        "not the device, but a thread of this process integrated the motion: {subject}",
    ),
    "stiff": _Row(
        _stiffness,
        "stability, not accuracy, limits the step size: the equations are stiff; method='bdf' may be faster",
    ),
}
"""How each kind of finding is made and worded, in the order in which findings are reported."""


def deficiency_findings(deficiencies: Iterable[Deficiency], model: Model) -> tuple[Finding, ...]:
    """Return the findings about linear systems without a unique solution, in the names of a model."""
    names, together = model.equation_names, model.equations_together
    return tuple(Finding("deficient", found.sentence(names, together)) for found in strongest(deficiencies))


def findings_of(motion: Integrated) -> tuple[Finding, ...]:
    """Return all findings about a motion."""
    return tuple(finding for row in ROWS.values() for finding in row.find(motion))


def notices_of_motion(findings: Iterable[Finding], where: str = "simulate") -> list[str]:
    """Return a message for each finding of one motion."""
    return [f"{where}: {sentence(finding)}" for finding in findings]


def sentence(finding: Finding) -> str:
    """Return the message of a finding."""
    return ROWS[finding.kind].sentence.format(subject=finding.subject, size=finding.size, t=finding.t)
