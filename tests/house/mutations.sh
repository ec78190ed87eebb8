#!/usr/bin/env bash
# Holds the quick tests to what they are for: in a copy of the sources one line of the physics at a time is
# made wrong – a sign, a factor, an order – and the quick tests of the room named beside it have to fail.
# Ends with 1 if one of them stays green, or a line is no longer where the table has it.
# usage: mutations.sh [NUMBER…]   all of them, or those with these numbers, from 1
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
copy=build/mutations
build=$copy/build/release

# What is wrong | file below sim/ | room, or room:cases | line as it is | what it becomes
mutations=(
  "Runge and Kutta's last stage begins half-way|ode/rk4.cpp|ode|follow(y, h, k3_, stage_);|follow(y, 0.5 * h, k3_, stage_);"
  "restitution slows what it should speed|contact/impulse.cpp|contact|-(1.0 + e) * vrel / k|-(1.0 - e) * vrel / k"
  "the cone is projected on at another slope|problem/cone.cpp|problem|/ (1.0 + mu * mu);|/ (1.0 + mu);"
  "Steiner's term has the other sign|body/mass_properties.cpp|body|Mat3::Identity() - d * d.transpose()|Mat3::Identity() + d * d.transpose()"
  "a solid is half as stiff in shear|elastic/corotated.cpp|elastic|law.slope = 2.0 * mu * strain|law.slope = 1.0 * mu * strain"
  "a ball's gap to an edge adds legs, not squares|collide/sphere_box.cpp|collide|beyond.cwiseMax(0.0).norm()|beyond.cwiseMax(0.0).sum()"
  "half of Coriolis's term at a joint|joint/joint_rows.cpp|joint|2.0 * s.b.omega.cross(slip);|1.0 * s.b.omega.cross(slip);"
  "spin of the rotor is counted in whole angles|flight/rotor.cpp|flight|phaseRate_ = 0.5 * omega;|phaseRate_ = omega;"
  "the spin's turn is made in the body's frame|math/rotation.cpp|math|scale * w.z()) * q;|scale * w.z()).conjugate() * q;"
  "forces at rest have the other sign of ω × L|contact/rows.cpp|contact|body.torque - body.omega.cross(body.L)|body.torque + body.omega.cross(body.L)"
  "the audit takes a spring's moment the other way round|audit/loads.cpp|audit|torque[body] += end.arm.cross(force);|torque[body] -= end.arm.cross(force);"
  "the audit counts a spring's energy twice|audit/loads.cpp|audit|return 0.5 * spring->stiffness|return 1.0 * spring->stiffness"
)

# copyInto FOLDER: the sources as they are now; what is unchanged keeps its time, so that it is not built again.
copyInto() {
  mkdir -p "$1"
  for part in CMakeLists.txt CMakePresets.json LICENSE cmake sim tests assets; do
    [[ ! -e $part ]] || cp -au "$part" "$1/"
  done
}

# replaced FILE FROM TO: makes FILE wrong, where FROM stands in it once.
replaced() {
  FROM=$2 TO=$3 perl -0pi -e 's/\Q$ENV{FROM}\E/$ENV{TO}/ and ++$n; END { exit($n == 1 ? 0 : 1) }' "$1"
}

# green ROOM:CASES: builds the room and runs these quick cases of it, to the first that fails.
green() {
  local room=${1%%:*} cases='*'
  if [[ $1 == *:* ]]; then cases=${1#*:}; fi
  cmake --build "$build" --target "test_$room" >"$copy/log" 2>&1 || { tail -n 40 "$copy/log" && exit 2; }
  (cd "$copy" && timeout 900 "build/release/tests/test_$room" -a "\"$cases\"~[long]~[.]") >"$copy/log" 2>&1 || return 1
  ! grep -q "No test" "$copy/log" || { echo "$1 names no case" >&2 && exit 2; }
}

# The case that failed.
failedCase() {
  awk '/^-----/ { inside = !inside; first = inside; next }
       first    { name = $0; first = 0 }
       /FAILED/ { print name; exit }' "$copy/log"
}

copyInto "$copy"
for mutation in "${mutations[@]}"; do  # an interrupted run leaves one behind
  IFS='|' read -r _ file _ <<<"$mutation"
  cmp -s "sim/$file" "$copy/sim/$file" || cp "sim/$file" "$copy/sim/$file"
done
cmake -S "$copy" --preset release -DTUMBLE_APP=OFF -DTUMBLE_RENDER=OFF >/dev/null
numbers=("$@")
if ((${#numbers[@]} == 0)); then mapfile -t numbers < <(seq ${#mutations[@]}); fi
missed=0 known=
for number in "${numbers[@]}"; do
  IFS='|' read -r what file room from to <<<"${mutations[number - 1]}"
  if [[ $known != *"|$room|"* ]]; then
    green "$room" || { echo "$room fails as it is" >&2 && tail -n 20 "$copy/log" >&2 && exit 1; }
    known+="|$room|"
  fi
  replaced "$copy/sim/$file" "$from" "$to" || { echo "sim/$file has no line '$from'" >&2 && exit 1; }
  verdict=$(green "$room" && echo MISSED || failedCase)
  cp "sim/$file" "$copy/sim/$file"
  if [[ $verdict == MISSED ]]; then missed=$((missed + 1)); fi
  printf '%2d %-52s %-18s %s\n' "$number" "$what" "$room" "$verdict"
done
echo "$((${#numbers[@]} - missed)) of ${#numbers[@]} caught"
((missed == 0))
