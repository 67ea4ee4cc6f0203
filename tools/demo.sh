#!/usr/bin/env bash
# The main job from end to end on the submissions of this repository; `make demo` runs it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
PATH="$PWD/.venv/bin:$PATH"

# Shows a command, then runs it.
run() {
    printf '\n$ %s\n' "$*"
    "$@"
}

example=(submissions/example-*/)

run leaderboard validate submissions/*/
run leaderboard grade --check "${example[0]}"
run leaderboard verify
run leaderboard rank
run leaderboard site build
printf '\nThe website is built. Open it in a browser:\n%s\n' "$PWD/site/dist/index.html"
