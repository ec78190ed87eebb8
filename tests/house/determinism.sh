#!/usr/bin/env bash
# Builds the program with both compilers at two levels and holds each build to the hashes of every demo.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
root=build/determinism

status=0
for compiler in g++ clang++; do
  for level in O1 O3; do
    build=$root/$compiler-$level
    cmake -G Ninja -S . -B "$build" -DTUMBLE_TESTS=OFF -DCMAKE_CXX_COMPILER=$compiler \
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-$level" >/dev/null
    cmake --build "$build" --target tumble >"$build/log" || { cat "$build/log" && exit 1; }
    printf '%s -%s: ' "$compiler" "$level"
    tests/house/bits.sh "$build/tumble" || status=1
  done
done
exit $status
