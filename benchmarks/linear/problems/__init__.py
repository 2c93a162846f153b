"""The problems by name."""

from __future__ import annotations

from ..problem import Problem
from .bicycle import BICYCLE
from .closed_chain import CLOSED_CHAIN, SMALL_CHAIN
from .root_locus import ROOT_LOCUS

PROBLEMS: dict[str, Problem] = {
    problem.name: problem for problem in (BICYCLE, SMALL_CHAIN, CLOSED_CHAIN, ROOT_LOCUS)
}
