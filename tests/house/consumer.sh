#!/usr/bin/env bash
# Installs a build into a scratch prefix and lets a small project outside the tree find and use it: the programs of
# API.md, each of which has to compile, to run and to end with 0.
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
mkdir "$scratch/programs"
awk -v folder="$scratch/programs" '
  /^## /     { name = $2 }
  /^```cpp$/ { file = folder "/" name ".cpp"; next }
  /^```$/    { file = "" }
  file       { print > file }' "$house/../../API.md"
programs=("$scratch"/programs/*.cpp)
((${#programs[@]} == 10)) || { echo "API.md has ${#programs[@]} programs, not 10" && exit 1; }
cmake -G Ninja -S "$house/consumer" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/prefix" \
  -DCMAKE_BUILD_TYPE=Release -DSOURCES="$scratch/programs" -DCMAKE_CXX_FLAGS="$flags" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
cmake --build "$scratch/build" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
cd "$scratch"
for program in "${programs[@]}"; do
  name=$(basename "$program" .cpp)
  echo "$name: $("$scratch/build/$name" "$scratch/prefix/share/tumble")" || { echo "$name of API.md failed" && exit 1; }
done

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
