#!/bin/sh
# Install packages of the system: make or Python, which symbody's set-up itself begins with.
# Usage: sh scripts/package.sh CHOICE...
# A choice is a package, or several in one word. The first choice that is on offer is installed. It fails where none is
# on offer, and where nothing may be installed: by INSTALL=no, or without being root or becoming root.
set -eu

case "${INSTALL:-yes}" in
    [Nn] | [Nn][Oo] | 0 | [Ff][Aa][Ll][Ss][Ee] | [Oo][Ff][Ff]) exit 1 ;;
esac
if [ "$(id -u)" = 0 ]; then root=; else root="sudo -n"; fi
command -v apt-get >/dev/null && $root true 2>/dev/null || exit 1

is_on_offer() {
    for package in "$@"; do
        apt-cache policy "$package" | grep -q 'Candidate: [^(]' || return 1
    done
}

$root apt-get update -qq
for choice in "$@"; do
    if is_on_offer $choice; then
        echo "Installing with apt-get: $choice (symbody's set-up begins with it)"
        $root env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends $choice >/dev/null
        exit
    fi
done
exit 1
