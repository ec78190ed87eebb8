#!/usr/bin/env bash
# Prints the figures that README.md and assets/report/README.md claim, each below the command that measures it. Ends with 1 if a
# command fails.
# usage: figures.sh BUILD_DIR
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=$1
tumble=$build/tumble
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
exec 2> >(grep -v '^simulating:' >&2)
status=0

section() {
  printf '\n== %s\n' "$1"
}

# Shows a command and runs it; a failure is remembered.
run() {
  printf '$ %s\n' "$*"
  "$@" || status=1
}

# The measured values that a test program's cases of figures print.
figures_of() {
  run "$build/tests/test_$1" '[figures]' --success | grep -A2 'warning:' | grep -v -e 'warning:' -e '^--' -e '^$'
}

# Simulates a scene and prints the instants of its first impacts. usage: hits COUNT SCENE options…
hits() {
  local count=$1
  shift
  run "$tumble" simulate "$@" -o "$scratch/hits" >"$scratch/log" || cat "$scratch/log"
  printf '$ tumble simulate %s\n  hits at' "$*"
  awk -F, -v n="$count" '$2 == "impact" && k++ < n { printf " %.6f", $1 }' "$scratch/hits/events.csv"
  printf ' s; events:'
  tail -n +2 "$scratch/hits/events.csv" | cut -d, -f2 | sort | uniq -c | awk '{ printf " %s %s", $1, $2 }'
  printf '; last at %s s\n' "$(tail -n 1 "$scratch/hits/events.csv" | cut -d, -f1)"
}

section "Closed forms of all demos: measured, exact, error, allowed"
run "$tumble" check

section "A ball of restitution 1 keeps its height over 100 bounces"
run "$tumble" check restitution-sweep --set world.duration=130 | grep -e '10: worst apex' -e claims

section "Free flight: parabola, orders of the attitude, momentum"
for program in "$build"/tests/test_*; do
  if [[ -x $program && -n $("$program" '[figures]' --list-test-names-only) ]]; then
    figures_of "${program##*/test_}"
  fi
done

section "The path of a brick: seven hits, confirmed at half the step; rattling at restitution 0.4"
hits 7 path-of-brick
hits 7 path-of-brick --set course.step=0.00026041666666666666
hits 3 path-of-brick --set materials.brick.restitution=0.4

section "Hard scenes, by stepping: an edge to slide over, seven unlike boxes, forty bodies in a tray"
for scene in tests/stability/*.toml; do
  run "$tumble" simulate "$scene" -o "$scratch/hard" | grep -v '^wrote'
done

section "CPU time of broad phases: us a step of n bodies, slope from 100 to 100,000; of closed-form flight: start, evaluation, ten thousand bodies sampled 60/s for 10 s; of contact problems by every solver, with the residual [m/s] it reaches; of Ls that are dropped, and of as many boxes; of trays that boxes and balls fall into, a simulated second"
cmake --build "$build" --target sim_bench >/dev/null 2>&1
run "$build/tests/sim_bench" --benchmark_repetitions=5 --benchmark_report_aggregates_only=true \
  --benchmark_min_time=0.1 2>/dev/null | grep -e '^\$' -e CPU -e _median -e '^dropped' -e '^tray'

section "CPU time that simulate adds for each number it writes"
cmake --build "$build" --target app_bench >/dev/null 2>&1
run "$build/tests/app_bench" --benchmark_repetitions=5 --benchmark_report_aggregates_only=true \
  2>/dev/null | grep -e '^\$' -e CPU -e _median

section "CPU time of an image of 200 bodies, 1280x720, shadows, four samples a pixel, PNG written"
cmake --build "$build" --target render_bench >/dev/null 2>&1
run "$build/tests/render_bench" "$scratch"

section "The window on a display in memory: first picture, image after image"
run tests/house/window.sh "$build" | grep -e '^\$' -e '^time' -e skipped

section "Speed against error: CPU seconds for a simulated second"
run "$tumble" report -o "$scratch/report" | tail -n 60

section "Beside other engines: at each error that they reach, how many times as much the cheapest costs"
cmake -S . -B "$build" -DTUMBLE_PEERS=ON >/dev/null
cmake --build "$build" --target peers >/dev/null 2>&1
run "$build/tests/peers/peers" --quick -o "$scratch/report"

section "The same bits from gcc and clang at -O0 to -O3, and with sanitizers"
run tests/house/determinism.sh

section "The same pixels as approved, by both contexts"
for kind in osmesa egl; do
  TUMBLE_GL=$kind run "$tumble" golden -o "$scratch/golden" | tail -1
done

section "Time of the quick tests"
run ctest --test-dir "$build" --label-regex '^quick$' --parallel "$(nproc)" | tail -3

exit $status
