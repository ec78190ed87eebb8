#!/usr/bin/env bash
# Installs a build into a scratch prefix and lets a small project outside the tree find and use it.
# usage: consumer.sh BUILD_DIR
set -euo pipefail
house=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --install "$1" --prefix "$scratch/prefix" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
# The consumer is compiled with the flags of the build: those of the sanitizers have to agree, and
# those of the processor, by which Eigen aligns.
flags=$(sed -n -e 's/^CMAKE_CXX_FLAGS:STRING=//p' -e 's/^CMAKE_CXX_FLAGS_RELEASE:STRING=//p' "$1/CMakeCache.txt" |
  tr '\n' ' ')
cmake -G Ninja -S "$house/consumer" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/prefix" \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="$flags" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
cmake --build "$scratch/build"
"$scratch/build/consumer"

# The installed program reads the installed assets, not those of the source tree.
"$scratch/prefix/bin/tumble" doctor | tee "$scratch/doctor"
grep -q "$scratch/prefix/share/tumble" "$scratch/doctor"

# It keeps goldens of a scene that is none of its own.
cd "$scratch"
cat >ball.toml <<'TOML'
[world]
duration = 0.2
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1.0
TOML
prefix/bin/tumble golden --folder kept --update ball.toml
prefix/bin/tumble golden --folder kept ball.toml | tee held
grep -q "goldens: 5 pass, 5 equal" held
