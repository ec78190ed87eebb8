#!/usr/bin/env bash
# Holds the program to the hashes of every demo in golden/hashes: the same bits of states, forces and events.
# Two threads simulate; the hashes were made by one. Ends with 1 if one differs. With --update it writes them anew.
# usage: bits.sh [--update | --until S] PROGRAM [DEMO…]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
update=
until=()
if [[ $1 == --update ]]; then update=1 && shift; fi
if [[ $1 == --until ]]; then until=("$1" "$2") && shift 2; fi
program=$1
shift
demos=("$@")
if ((${#demos[@]} == 0)); then
  for scene in assets/demos/*.toml; do demos+=("$(basename "$scene" .toml)"); done
fi

if [[ $update ]]; then
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
  mkdir -p golden/hashes
  for demo in "${demos[@]}"; do  # ten samples a second: each hangs on all that was before
    "$program" simulate -q "$demo" --rate 10 -o "$scratch" --hash "golden/hashes/$demo.txt" >/dev/null
  done
  exit
fi

status=0
for demo in "${demos[@]}"; do
  "$program" verify -q --threads 2 "$demo" "golden/hashes/$demo.txt" "${until[@]}" || status=1
done
((status == 0)) && echo "${#demos[@]} demos: identical"
exit $status
