#!/usr/bin/env bash
# What it costs a scene that something is there which it does not use, counted in instructions (callgrind).
#   cost = ((scene with it − scene) − (it alone − nothing)) / (scene − nothing),
# where "nothing" is the scene's settings over an empty world; what is added may cost what it costs by itself, and
# the scene no more than 2 % above. Prints the table; ends with 1 if a cost is 2 % or more.
# usage: needs.sh PROGRAM [SCENE…]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/needs
program=$(realpath "$1")
shift
scenes=("$@")
if ((${#scenes[@]} == 0)); then mapfile -t scenes < <(basename -as .toml "$here"/scenes/*); fi
mapfile -t features < <(basename -as .toml "$here"/features/*)
command -v valgrind >/dev/null || { echo "valgrind is not there" && exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# header FEATURE WORD: what stands behind "# WORD" in its first lines.
header() { sed -nE "/^#/!q; s/^# $2 //p" "$here/features/$1.toml"; }

# instructions NAME FEATURE: of a run of NAME.toml, with what FEATURE sets.
instructions() {
  local sets=() key
  for key in $(header "$2" set); do sets+=(--set "$key"); done
  setarch -R valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" simulate -q "$1.toml" -o out "${sets[@]}" \
    2>log >/dev/null || { cat log >&2 && exit 1; }
  sed -n 's/^==.*Collected : //p' log
}

status=0
printf '| feature |'; printf ' %s |' "${scenes[@]}"; printf '\n|---|'; printf -- '---|%.0s' "${scenes[@]}"; echo
declare -A nothing alone
for scene in "${scenes[@]}"; do
  awk '/^\[\[/ && ++n == 2 { exit } { print }' "$here/scenes/$scene.toml" >empty-$scene.toml
  cp "$here/scenes/$scene.toml" alone-$scene.toml
  nothing[$scene]=$(instructions empty-$scene materials)
  alone[$scene]=$(instructions alone-$scene materials)
done
for feature in "${features[@]}"; do
  printf '| %s |' "$feature"
  for scene in "${scenes[@]}"; do
    method=$(sed -n 's/^method = "\(.*\)"/\1/p' "$here/scenes/$scene.toml")
    verdict=
    for word in used refused changed; do
      is=$(header "$feature" "$word (by|in)" | sed 's/:.*//')
      if grep -qwE "$scene|$method" <<<"$is"; then verdict=$word; fi
    done
    if [[ $verdict ]]; then
      printf ' %s |' "$verdict"
    else
      cat empty-$scene.toml "$here/features/$feature.toml" >it.toml
      cat alone-$scene.toml "$here/features/$feature.toml" >both.toml
      it=$(instructions it "$feature")
      both=$(instructions both "$feature")
      cost=$(awk -v b="$both" -v s="${alone[$scene]}" -v i="$it" -v n="${nothing[$scene]}" \
        'BEGIN { printf "%.2f", 100 * ((b - s) - (i - n)) / (s - n) }')
      printf ' %s %% |' "$cost"
      awk -v c="$cost" 'BEGIN { exit !(c < 2) }' || status=1
    fi
  done
  echo
done
exit $status
