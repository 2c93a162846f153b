"""``symbody run``: a worksheet from its file to what Maple would print, statement by statement, and a report."""

from symbody.worksheet.run.command import run_file
from symbody.worksheet.run.execution import outcomes
from symbody.worksheet.run.report import Report

__all__ = ["Report", "outcomes", "run_file"]
