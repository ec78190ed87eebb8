#!/usr/bin/env bash
# Lets two builds of the program simulate every demo and compares what they write, byte for byte. Ends
# with 1 if a file differs.
# usage: bits.sh FOLDER PROGRAM PROGRAM [DEMO…]
set -euo pipefail
folder=$1 programs=("$2" "$3")
shift 3
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
demos=("$@")
if ((${#demos[@]} == 0)); then
  for scene in assets/demos/*.toml; do demos+=("$(basename "$scene" .toml)"); done
fi

status=0
for demo in "${demos[@]}"; do
  for k in 0 1; do
    rm -rf "${folder:?}/$k/$demo"
    "${programs[k]}" simulate -q "assets/demos/$demo.toml" -o "$folder/$k/$demo" >/dev/null
  done
  # The certificate has the CPU time in it.
  diff -rq -x summary.json "$folder/0/$demo" "$folder/1/$demo" || status=1
done
((status == 0)) && echo "${#demos[@]} demos: identical"
exit $status
