#!/usr/bin/env bash
# Makes sure that a program is there for the tests that need it, by the system's package manager.
# Usage: install-program.sh PROGRAM WHAT_IS_LOST; the package has the program's name.
# Without it and without a way to install it: a notice, and those tests skip. In CI that is a failure.
set -euo pipefail
program=$1 loss=$2

find_program() {
    command -v "$program" >/dev/null 2>&1 || [[ -x "/usr/bin/$program" ]]
}

install_program() {
    local -a as_root=()
    command -v apt-get >/dev/null 2>&1 || return 1
    if [[ "$(id -u)" -ne 0 ]]; then
        command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null || return 1
        as_root=(sudo -n)
    fi
    echo "Installing $program for the tests (apt-get) ..." >&2
    "${as_root[@]}" apt-get -qq update >&2 &&
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
            apt-get -qq install -y --no-install-recommends "$program" >/dev/null
}

if find_program; then
    exit 0
fi
if install_program && find_program; then
    exit 0
fi

cat >&2 <<NOTICE

  ************************************************************************
    The program $program is not here and could not be installed.
    TESTS WILL BE SKIPPED: $loss.
    Install the package $program, then run this again.
  ************************************************************************

NOTICE
[[ -z "${CI:-}" ]]
