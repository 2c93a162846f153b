"""The command line: ``symbody``, or ``python -m symbody``, lists its commands."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

import symbody

COMMANDS = {
    "version": "print the version",
    "doctor": "report which packages, extras and programs are there, and how to get the missing ones",
    "run": "run an MBSymba worksheet, without Maple",
    "convert": "write an MBSymba worksheet as a Python program",
}

_PIPE_CLOSED = 141
"""What a shell reports of a program that the signal SIGPIPE ends."""

EPILOG = """\
symbody is a library: import symbody as sb. help(sb) lists its functions; the guides are in docs/.
Exit status: 0 if all is well, 1 if the doctor finds that something that symbody needs is missing or broken, 2 if the
command is unknown. Of run: 1 if statements failed, 2 if outputs differ (--check), 3 if the file is not readable.
"""


def main(words: Sequence[str] | None = None) -> int:
    """Run a command and return the exit status; where nobody reads on, as in ``| head``, it ends quietly."""
    try:
        status = _command(words)
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what is left is flushed at the end
        return _PIPE_CLOSED
    return status


def _command(words: Sequence[str] | None) -> int:
    parser = _parser()
    given = parser.parse_args(words)
    command = given.command
    if given.version or command == "version":
        print(f"symbody {symbody.__version__}")
    elif command == "doctor":
        return _doctor()
    elif command == "run":
        from symbody.worksheet.run import run_file  # noqa: PLC0415 - the interpreter of worksheets

        return run_file(given)
    elif command == "convert":
        from symbody.worksheet.convert import convert_file  # noqa: PLC0415 - likewise

        return convert_file(given)
    else:
        parser.print_help()
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m symbody",
        description="Symbolic equations of motion of multibody systems: derived, checked, compiled and simulated.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="store_true", help=COMMANDS["version"])
    commands = parser.add_subparsers(dest="command", title="commands", metavar="command")
    for name, purpose in COMMANDS.items():
        command = commands.add_parser(name, help=purpose, description=f"{purpose[0].upper()}{purpose[1:]}.")
        if name == "run":
            add_run_options(command)
        elif name == "convert":
            add_convert_options(command)
    return parser


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


def _doctor() -> int:
    from symbody.doctor import checks, report  # noqa: PLC0415 - it loads the compiler of machine code

    found = checks()
    print(report(found))
    return int(any(one.is_fault for one in found))


if __name__ == "__main__":
    sys.exit(main())
