#!/usr/bin/env bash
# Builds the fuzzers with clang and lets each run for its ten minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake -G Ninja -S . -B build/fuzz -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang \
  -DCMAKE_BUILD_TYPE=Debug -DTUMBLE_FUZZ=ON -DTUMBLE_RENDER=OFF -DTUMBLE_APP=OFF >/dev/null
cmake --build build/fuzz --target scene_fuzz mesh_fuzz
ctest --test-dir build/fuzz --output-on-failure --tests-regex '^fuzz:'
