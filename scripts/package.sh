#!/bin/sh
# Install packages of the system where that is allowed: Python or make, which scripts/tools.py itself begins with.
# Usage: sh scripts/package.sh PACKAGE...
set -eu
if [ "$(id -u)" = 0 ]; then root=; else root="sudo -n"; fi
if [ "${INSTALL:-yes}" != no ] && command -v apt-get >/dev/null && $root true 2>/dev/null; then
    echo "Installing with apt-get: $* (symbody's set-up begins with it)"
    $root apt-get update -qq
    $root env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "$@" >/dev/null
else
    echo "Missing, and not to be installed from here: $*. Install it from your system's packages, then again."
    exit 1
fi
