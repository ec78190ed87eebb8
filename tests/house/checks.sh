#!/usr/bin/env bash
# What continuous integration sees beside the quick tests, step by step: each prints its name, its time
# and its verdict; the last line counts them. Needs the build of ./run tests in build/release.
# usage: checks.sh [STEP…]   all of them but those on request, or those named
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
release=build/release
root=build/checks
clang=$root/clang
sanitized=$root/sanitized
jobs=$(nproc)
mkdir -p "$root"
export LSAN_OPTIONS=suppressions=$PWD/tests/house/leaks.supp:print_suppressions=0

# Everything by clang, as a reader of its warnings and as a second opinion on bits; with fuzzers.
warnings() {
  cmake -G Ninja -S . -B "$clang" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" \
    -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DTUMBLE_FUZZ=ON &&
    cmake --build "$clang" --target tumble scene_fuzz mesh_fuzz
}

bits() {
  tests/house/bits.sh "$clang/tumble"
}

# fuzzed NAME CORPUS options and further corpora…: a minute of it. Of one that finds something, the end
# of its log: where, and the finding in base64.
fuzzed() {
  local found=$root/found-$1 log=$root/fuzz-$1.log
  mkdir -p "$found"
  "$clang/tests/fuzz/$1_fuzz" -seed=1 -max_total_time=60 -timeout=20 -error_exitcode=1 -rss_limit_mb=2048 -max_len=8192 \
    -artifact_prefix="$found/" "$found" "${@:2}" >"$log" 2>&1 && return
  echo "the $1 fuzzer, by its log $log:"
  tail -n 25 "$log"
  local finding
  for finding in "$found"/{timeout,crash,oom,leak}-*; do
    [[ -f $finding ]] && echo "$finding, to be had by base64 -d:" && base64 "$finding"
  done
  return 1
}
# Both readers at once.
fuzz() {
  local status=0
  fuzzed scene tests/fuzz/corpus -dict=tests/fuzz/scene.dict &
  fuzzed mesh assets/meshes tests/fuzz/meshes || status=1
  wait $! || status=1
  return $status
}

# The physics by clang with address and undefined-behaviour checks, without precompiled headers. The
# readers are under the same checks in the fuzzers.
sanitized_rooms=(math ode shape body flight collide problem contact joint world)
sanitized_build() {
  cmake -G Ninja -S . -B "$sanitized" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang \
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -gline-tables-only" \
    -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror -fsanitize=address,undefined -fno-sanitize-recover=undefined" \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DTUMBLE_RENDER=OFF -DTUMBLE_APP=OFF &&
    cmake --build "$sanitized" --target "${sanitized_rooms[@]/#/test_}"
}
sanitized_run() {
  local room rooms dear
  for room in "${sanitized_rooms[@]}"; do  # of a program that ends before it lists its cases, CTest says nothing
    [[ -n $("$sanitized/tests/test_$room" --list-tests --verbosity quiet) ]] && continue
    echo "test_$room lists no case"
    return 1
  done
  rooms=$(IFS='|' && echo "${sanitized_rooms[*]}")
  # What took a tenth of a second without the checks, by the times that ./run tests left.
  dear=$(awk '$NF > 0.1 { $NF = $(NF - 1) = ""; gsub(/[^a-zA-Z0-9: ]/, "."); sub(/ +$/, ""); print }' \
    "$release/Testing/Temporary/CTestCostData.txt" | paste -sd '|')
  ctest --test-dir "$sanitized" --no-tests=error --output-on-failure --parallel "$jobs" --timeout 300 \
    --label-regex '^quick$' --tests-regex "^($rooms): ?" --exclude-regex "^(${dear:-none})$"
}

# References in many digits, which the quick tests do without.
oracle() {
  cmake --build "$release" --target test_oracle && "$release/tests/test_oracle" "~[long]"
}

# Random scenes under the audit: the cases tagged [soak], wherever they are.
soak() {
  local program cases=0 status=0
  for program in "$release"/tests/test_*; do
    [[ -x $program && -f $program ]] || continue
    [[ -n $("$program" '[soak]' --list-test-names-only) ]] || continue
    cases=$((cases + 1))
    "$program" '[soak]' || status=1
  done
  if ((cases == 0)); then
    echo "no case is tagged [soak]"
    return 77
  fi
  return $status
}

# The physics made wrong, line by line: quick tests have to see it.
mutations() {
  tests/house/mutations.sh
}

# What it costs a scene that something is there which it does not use.
needs() {
  tests/stability/needs.sh "$release/tumble"
}

# A share of the subjects for each core: one process draws by one thread for most of the time.
egl_goldens() {
  local lane status=0 subjects lanes=()
  mapfile -t subjects < <("$release/tumble" list -q && echo viewer)
  for ((lane = 0; lane < jobs; lane++)); do
    # shellcheck disable=SC2046 # several subjects
    TUMBLE_GL=egl "$release/tumble" golden -o "$root/golden-$lane" \
      $(printf '%s\n' "${subjects[@]}" | awk -v lane="$lane" -v lanes="$jobs" 'NR % lanes == lane') &
    lanes+=($!)
  done
  for lane in "${lanes[@]}"; do wait "$lane" || status=1; done
  return $status
}

# The page of a run, played by a browser if there is one.
page() {
  tests/house/page.sh "$release"
}

# The gallery's page, by the rules of a tool for accessibility.
gallery() {
  tests/house/axe.sh "$release"
}

# Runs as glTF files, by Khronos' validator.
gltf() {
  tests/house/gltf.sh "$release"
}

# The window, driven by keys and mouse on a virtual display.
window() {
  tests/house/window.sh "$release"
}

passed=0 failed=0
# step NAME FUNCTION: runs it and tells how it went; 77 is a step that has nothing to do.
step() {
  local log=$root/$2.log start=$SECONDS code=0 verdict=passed cpu
  "$2" >"$log" 2>&1 &
  wait $! || code=$?
  case $code in
    0) passed=$((passed + 1)) ;;
    77) verdict="skipped: $(tail -n 1 "$log")" ;;
    *)
      verdict="FAILED ($code), see $log"
      failed=$((failed + 1))
      ;;
  esac
  # The CPU time of all ended children so far, of which this step had the rest.
  times >"$root/times"
  cpu=$(awk -F'[ms ]' 'NR == 2 { print int($1 * 60 + $2 + $4 * 60 + $5) }' "$root/times")
  printf '%-58s %5d s %6d CPU s  %s\n' "$1" $((SECONDS - start)) $((cpu - spent)) "$verdict"
  spent=$cpu
  if [[ $verdict == FAILED* ]]; then tail -n 60 "$log"; fi
}
spent=0

steps=(
  "warnings:clang builds program and fuzzers without a warning"
  "bits:clang's program has the same bits in every demo"
  "fuzz:scene and mesh files survive a minute of fuzzing"
  "sanitized_build:without precompiled headers, with sanitizers, without a warning"
  "sanitized_run:quick tests of physics under sanitizers"
  "oracle:references in many digits"
  "egl_goldens:goldens by EGL"
  "page:pages of runs play in a headless browser"
  "gltf:glTF files of runs have no remark by Khronos' validator"
  "window:the window does what keys and mouse ask for"
  "gallery:the gallery's page has no finding by axe-core"
)
# Run when asked for: dear, or known not to hold everywhere – random scenes of which some, by stepping in
# joints, end apart from the audit, and scenes beside which something moves.
on_request=(
  "soak:random scenes under the audit"
  "mutations:quick tests catch each line of the physics made wrong"
  "needs:what a scene does not use costs it less than 2 %"
)
for asked in "$@"; do
  [[ " ${steps[*]} ${on_request[*]}" == *" $asked:"* ]] && continue
  known=("${steps[@]}" "${on_request[@]}")
  echo "checks: no step is called '$asked'; there are ${known[*]%%:*}" >&2
  exit 2
done
for entry in "${steps[@]}"; do
  name=${entry%%:*}
  if (($# == 0)) || [[ " $* " == *" $name "* ]]; then step "${entry#*:}" "$name"; fi
done
for entry in "${on_request[@]}"; do
  name=${entry%%:*}
  if [[ " $* " == *" $name "* ]]; then step "${entry#*:}" "$name"; fi
done
echo "$passed passed, $failed failed"
((failed == 0))
