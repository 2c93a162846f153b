"""Comparing a run with the output that the worksheet's file contains."""

from symbody.worksheet.check.failures import expected_failures
from symbody.worksheet.check.verdict import Verdict, verdicts

__all__ = ["Verdict", "expected_failures", "verdicts"]
