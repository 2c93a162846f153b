#!/bin/sh
# Run a Python that is new enough for symbody; install one where there is none and that is allowed, or say what to do.
# Usage: sh scripts/python.sh ARGUMENT...
# PYTHON in the environment names the one to take; INSTALL=no leaves the system as it is.
# It is a shell script since older Pythons can't read what is written for newer ones, not even what says so.
set -eu

oldest=11 # as requires-python in pyproject.toml: 3.11
minors="14 13 12 11"

is_new_enough() {
    "$1" -c "import sys; sys.exit(sys.version_info < (3, $oldest))" >/dev/null 2>&1
}

# Which one that is: 3.9.18 at /usr/bin/python3.
described() {
    "$1" -c 'import sys; print("%d.%d.%d at %s" % (sys.version_info[:3] + (sys.executable,)))' 2>/dev/null
}

# Go on as the first Python on the PATH that will do, if there is one.
run_first() {
    for name in python3 $(printf 'python3.%s ' $minors) python; do
        if is_new_enough "$name"; then exec "$name" "$@"; fi
    done
}

# Say what was found, and the way out.
fail() {
    printf '\nPython 3.%s or newer is needed, found %s.\n%s\n\n' "$oldest" "$1" "$2" >&2
    exit 1
}

# Install the newest Python that the system's package manager has, if that is allowed.
install() {
    set --
    for minor in $minors; do
        set -- "$@" "python3.$minor python3.$minor-venv"
    done
    sh "${0%/*}/package.sh" "$@"
}

if [ -n "${PYTHON:-}" ]; then
    if is_new_enough "$PYTHON"; then exec "$PYTHON" "$@"; fi
    found=$(described "$PYTHON") || found="no program $PYTHON that runs"
    fail "$found: PYTHON=$PYTHON names it" \
        "Leave PYTHON out, so that one is looked for, or name another one: make PYTHON=/usr/local/bin/python3.12 demo"
fi

run_first "$@"
install >&2 || true
run_first "$@"
fail "$(described python3 || echo "none on the PATH")" \
    "Install one from the packages of your system or from https://www.python.org, or name one that is elsewhere:
make PYTHON=/usr/local/bin/python3.12 demo"
