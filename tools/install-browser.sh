#!/usr/bin/env bash
# Makes sure that Chromium is there for the browser tests, by the system's package manager.
# Without it and without a way to install it: a notice, and the browser tests skip. In CI that is a failure.
set -euo pipefail

find_chromium() {
    command -v chromium >/dev/null 2>&1 || [[ -x /usr/bin/chromium ]]
}

install_chromium() {
    local -a as_root=()
    command -v apt-get >/dev/null 2>&1 || return 1
    if [[ "$(id -u)" -ne 0 ]]; then
        command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null || return 1
        as_root=(sudo -n)
    fi
    echo "Installing chromium for the browser tests (apt-get) ..." >&2
    "${as_root[@]}" apt-get -qq update >&2 &&
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
            apt-get -qq install -y --no-install-recommends chromium >/dev/null
}

if find_chromium; then
    exit 0
fi
if install_chromium && find_chromium; then
    exit 0
fi

cat >&2 <<'NOTICE'

  ************************************************************************
  *  Chromium is not here and could not be installed.                    *
  *  THE BROWSER TESTS WILL BE SKIPPED: nothing will open the built      *
  *  website. Install the package `chromium`, so that /usr/bin/chromium  *
  *  exists, and run `make browser` again.                               *
  ************************************************************************

NOTICE
[[ -z "${CI:-}" ]]
