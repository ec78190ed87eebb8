#!/usr/bin/env bash
# The sources are laid out as .clang-format says. Exit 77: skipped.
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 1
if ! command -v clang-format >/dev/null; then
  echo "skipped: clang-format is not installed"
  exit 77
fi
./run format --check
