#!/usr/bin/env bash
# Prints the figures that the README claims, each after the command that measures it.
# usage: figures.sh BUILD_DIR
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=$1
status=0

# Shows a command, runs it, remembers a failure.
figure() {
  echo
  echo "== $1"
  shift
  echo "\$ $*"
  "$@" || status=1
}

figure "closed forms that the demos are held to" "$build/tumble" check
exit $status
