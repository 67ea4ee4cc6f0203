#!/usr/bin/env bash
# Makes sure that the HTML checker (vnu) is there for its test: from npm, by the exact lock beside this script.
# Without Java or npm: a notice, and its test skips. In CI that is a failure.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

lock=tools/html-checker/package-lock.json
folder=.venv/html-checker

install_checker() {
    command -v npm >/dev/null 2>&1 || return 1
    echo "Installing the HTML checker for its test (npm) ..." >&2
    rm -rf "$folder"
    mkdir -p "$folder"
    cp tools/html-checker/{package.json,package-lock.json,.npmrc} "$folder"
    # Scripts of packages do not run (.npmrc); npm refuses what differs from the lock's checksums.
    (cd "$folder" && npm ci --silent >&2) && touch "$folder/.installed"
}

if command -v java >/dev/null 2>&1; then
    if [[ -e "$folder/.installed" ]] && cmp -s "$lock" "$folder/package-lock.json"; then
        exit 0
    fi
    if install_checker; then
        exit 0
    fi
fi

cat >&2 <<'NOTICE'

  ************************************************************************
  *  The HTML checker is not here and could not be installed.            *
  *  ITS TEST WILL BE SKIPPED: nothing will hold the built pages         *
  *  against the standard. It needs Java 11 or newer and npm; install    *
  *  both and run `make checker` again.                                  *
  ************************************************************************

NOTICE
[[ -z "${CI:-}" ]]
