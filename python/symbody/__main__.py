"""The command line: ``python -m symbody`` lists its commands."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib.metadata import version

COMMANDS = {
    "version": "print the version",
    "doctor": "report which packages, extras and programs are there, and how to get the missing ones",
}

EPILOG = """\
symbody is a library: import symbody as sb. help(sb) lists its functions; the guides are in docs/.
Exit status: 0 if all is well, 1 if the doctor finds that something that symbody needs is missing or broken, 2 if the
command is unknown.
"""


def main(words: Sequence[str] | None = None) -> int:
    """Run a command and return the exit status."""
    parser = _parser()
    command = parser.parse_args(words).command
    if command == "version":
        print(f"symbody {version('symbody')}")
    elif command == "doctor":
        return _doctor()
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
        commands.add_parser(name, help=purpose, description=f"{purpose.capitalize()}.")
    return parser


def _doctor() -> int:
    from symbody.doctor import checks, report  # noqa: PLC0415 - it loads the compiler of machine code

    found = checks()
    print(report(found))
    return int(any(one.is_fault for one in found))


if __name__ == "__main__":
    sys.exit(main())
