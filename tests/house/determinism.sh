#!/usr/bin/env bash
# Builds the program with both compilers at two levels and compares what every demo writes, byte for byte.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
root=build/determinism
numbers=(trajectory.csv events.csv contacts.csv)

for compiler in g++ clang++; do
  for level in O1 O3; do
    build=$root/$compiler-$level
    cmake -G Ninja -S . -B "$build" -DTUMBLE_TESTS=OFF -DCMAKE_CXX_COMPILER=$compiler \
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-$level" >/dev/null
    cmake --build "$build" --target tumble >"$build/log" || { cat "$build/log" && exit 1; }
    for scene in assets/demos/*.toml; do
      "$build/tumble" simulate "$scene" -o "$build/out/$(basename "$scene" .toml)" >/dev/null
    done
  done
done

status=0
for scene in assets/demos/*.toml; do
  demo=$(basename "$scene" .toml)
  for file in "${numbers[@]}"; do
    for other in g++-O3 clang++-O1 clang++-O3; do
      if ! cmp "$root/g++-O1/out/$demo/$file" "$root/$other/out/$demo/$file"; then status=1; fi
    done
    printf '%-24s %-15s %8d lines  %s\n' "$demo" "$file" \
      "$(wc -l <"$root/g++-O1/out/$demo/$file")" "$(sha256sum <"$root/g++-O1/out/$demo/$file" | cut -c1-16)"
  done
done
((status == 0)) && echo "gcc and clang, -O1 and -O3: identical"
exit $status
