"""The command line: ``symbody``, or ``python -m symbody``, lists its commands."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib.metadata import version

from symbody.worksheet.command_line import add_convert_options, add_run_options

COMMANDS = {
    "version": "print the version",
    "doctor": "report which packages, extras and programs are there, and how to get the missing ones",
    "run": "run an MBSymba worksheet, without Maple",
    "convert": "write an MBSymba worksheet as a Python program",
}

EPILOG = """\
symbody is a library: import symbody as sb. help(sb) lists its functions; the guides are in docs/.
Exit status: 0 if all is well, 1 if the doctor finds that something that symbody needs is missing or broken, 2 if the
command is unknown. Of run: 1 if statements failed, 2 if outputs differ (--check), 3 if the file is not readable.
"""


def main(words: Sequence[str] | None = None) -> int:
    """Run a command and return the exit status."""
    parser = _parser()
    given = parser.parse_args(words)
    command = given.command
    if command == "version":
        print(f"symbody {version('symbody')}")
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
    parser.add_argument("--version", action="version", version=f"symbody {version('symbody')}")
    commands = parser.add_subparsers(dest="command", title="commands", metavar="command")
    for name, purpose in COMMANDS.items():
        command = commands.add_parser(name, help=purpose, description=f"{purpose[0].upper()}{purpose[1:]}.")
        if name == "run":
            add_run_options(command)
        elif name == "convert":
            add_convert_options(command)
    return parser


def _doctor() -> int:
    from symbody.doctor import checks, report  # noqa: PLC0415 - it loads the compiler of machine code

    found = checks()
    print(report(found))
    return int(any(one.is_fault for one in found))


if __name__ == "__main__":
    sys.exit(main())
