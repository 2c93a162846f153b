"""What ``symbody run`` and ``symbody convert`` take."""

from __future__ import annotations

import argparse
from pathlib import Path

__all__ = ["add_convert_options", "add_run_options"]


def add_run_options(parser: argparse.ArgumentParser) -> None:
    """Add what ``symbody run`` takes."""
    parser.add_argument(
        "file", type=Path, help="the worksheet: a text export, .mpl, .txt, .mw, or a saved session"
    )
    parser.add_argument(
        "--out", type=Path, metavar="DIR", help="where files are written (default: SHEET_out)"
    )
    parser.add_argument("--check", action="store_true", help="compare with the output that the file contains")
    parser.add_argument("--quiet", action="store_true", help="print errors and the last line only")
    parser.add_argument("--verbose", action="store_true", help="show what was taken for remarks")
    parser.add_argument("--width", type=int, metavar="N", help="cut printed lines to N characters")
    parser.add_argument(
        "--any-folder", action="store_true", help="allow the sheet to read and write outside of its folders"
    )


def add_convert_options(parser: argparse.ArgumentParser) -> None:
    """Add what ``symbody convert`` takes."""
    parser.add_argument("file", type=Path, help="the worksheet")
    parser.add_argument("program", type=Path, help="the Python program to be written, such as model.py")
