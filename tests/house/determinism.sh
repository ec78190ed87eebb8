#!/usr/bin/env bash
# Builds the program by both compilers at four levels, and with sanitizers, and holds each build to the hashes of every
# demo; what is slow only to their first half second.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
root=build/determinism

status=0
# hold COMPILER FLAGS [--until S]
hold() {
  local name=$1${2// /} flags=$2
  local build=$root/${name//,/-}
  cmake -G Ninja -S . -B "$build" -DTUMBLE_TESTS=OFF -DCMAKE_CXX_COMPILER="$1" \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="$flags" >/dev/null
  cmake --build "$build" --target tumble >"$build/log" || { cat "$build/log" && exit 1; }
  printf '%s %s%s: ' "$1" "$flags" "${*:3:2}"
  tests/house/bits.sh "${@:3}" "$build/tumble" || status=1
}

for compiler in g++ clang++; do
  hold $compiler -O0 --until 0.5
  for level in -O1 -O2 -O3; do hold $compiler $level; done
done
hold clang++ "-O1 -fsanitize=address,undefined -fno-sanitize-recover=undefined" --until 0.5
exit $status
