#!/usr/bin/env bash
# Drives the window by synthetic input on a virtual display, as a person would: keys, drag, a saved file.
# What it did is read off the pictures that it is asked to write. usage: window.sh BUILD_DIR; 77 without xdotool
set -euo pipefail
if [[ ${2:-} != inside ]]; then
  for tool in xvfb-run xauth xdotool; do
    command -v "$tool" >/dev/null || { echo "window: skipped, there is no $tool"; exit 77; }
  done
  # The screen is a file, so that what stands on it can be read at any instant.
  FRAMEBUFFER=$(mktemp -d)
  export FRAMEBUFFER
  # With a key of ours xvfb-run has no folder of its own, which it may fail to tidy up.
  touch "$FRAMEBUFFER/key"
  exec xvfb-run --auto-servernum --auth-file="$FRAMEBUFFER/key" \
    --server-args="-screen 0 1280x800x24 -fbdir $FRAMEBUFFER" "$0" "$1" inside
fi
tumble=$(realpath "$1")/tumble
scratch=$(mktemp -d)
cd "$scratch"

# scene COLOUR
scene() {
  cat >fall.toml <<TOML
[world]
duration = 1.0
[[body]]
name = "floor"
shape = { plane = [0, 1, 0, 0] }
[[body]]
name = "box"
shape = { box = [0.5, 0.3, 0.4] }
mass = 2.0
position = [0, 0.6, 0]
colour = $1
TOML
}
scene '[0.2, 0.4, 0.7]'
"$tumble" view fall.toml >log 2>&1 &
program=$!
trap 'kill "$program" 2>/dev/null || true; rm -rf "$scratch" "$FRAMEBUFFER"' EXIT

status=0
tell() {  # what was asked, whether it came about
  if [[ $2 == 0 ]]; then echo "ok   $1"; else echo "FAIL $1"; status=1; fi
}
# until SECONDS COMMAND…: tries it until it succeeds.
until_done() {
  local end=$((SECONDS + $1))
  shift
  until "$@" 2>/dev/null; do
    ((SECONDS < end)) || return 1
    kill -0 "$program" 2>/dev/null || { cat log; return 1; }
    sleep 0.1
  done
}
found() { window=$(xdotool search --onlyvisible --name tumble | head -n 1) && [[ -n $window ]]; }
# picture NAME K: the window writes image K, which is kept as NAME.png.
whole() { [[ -f $1 ]] && tail -c 8 "$1" | grep -q IEND; }
picture() {
  rm -f fall-*.png
  xdotool key s
  until_done 5 whole "$(printf 'fall-%06d.png' "$2")" || return 1
  cp "$(printf 'fall-%06d.png' "$2")" "$1.png"
}
same() { cmp -s "$1.png" "$2.png"; }
differ() { ! same "$1" "$2"; }
check() { local what=$1; shift; if "$@"; then tell "$what" 0; else tell "$what" 1; fi; }

until_done 60 found || { echo "FAIL no window"; cat log; exit 1; }
xdotool windowfocus "$window"
sleep 1
# The run is played as it is recorded; End goes to its last image, whatever has been played.
# A key that is down for less than an image takes may be missed: such steps are tried again.
ended() { xdotool key End && picture end 60; }
check "End shows the last image, s writes it" until_done 60 ended
stepped() { xdotool key End && sleep 0.3 && xdotool key Left && picture back 59; }
check "an arrow steps back by one image" until_done 60 stepped
drag() {
  xdotool mousemove 700 300 mousedown 1
  for x in 720 760 800 840; do xdotool mousemove "$x" 320; sleep 0.1; done
  xdotool mouseup 1
  sleep 0.3
}
drag
picture turned 59 && check "a drag turns the picture" differ back turned
xdotool key k
xdotool key v
picture home 59 && check "v goes back to the view of the start" same back home
xdotool key 1
picture again 59 && check "1 goes back to the view that k kept" same turned again
begun() { xdotool key v Home && picture start 0; }
check "Home shows the first image" until_done 60 begun
check "which differs from the last" differ start back
scene '[0.8, 0.3, 0.2]'
reloaded() { xdotool key Home && picture fresh 0 && differ start fresh; }
check "a scene that is saved is shown anew" until_done 30 reloaded
xdotool key End l
later() { rm -f fall-*.png; xdotool key s; sleep 0.5; ls fall-*.png | awk -F'[-.]' '{ exit !($2 + 0 > 60) }'; }
check "l lets it run on beyond its end" until_done 30 later

# How fast it is, told, not judged: what else runs on the machine counts too.
now() { date +%s%3N; }
# answered KEY: ms from before it is pressed until the screen differs; 9999 if it never does
answered() {
  local start end
  cp "$FRAMEBUFFER/Xvfb_screen0" before
  start=$(now)
  end=$((SECONDS + 3))
  xdotool keydown "$1"
  while cmp -s before "$FRAMEBUFFER/Xvfb_screen0"; do
    ((SECONDS < end)) || { start=$(($(now) - 9999)); break; }
  done
  echo $(($(now) - start))
  xdotool keyup "$1"
}
answers() {
  for _ in 1 2 3 4 5 6 7 8; do
    for key in Left Right; do
      sleep 0.4
      answered "$key"
    done
  done | sort -n
}
xdotool key l  # back from the live world
sleep 0.5
xdotool key Home
sleep 0.5
mapfile -t times < <(answers)
echo "time until a key shows on the screen: median ${times[8]} ms, longest ${times[15]} ms of ${#times[@]}"
kill "$program"
wait "$program" 2>/dev/null || true
# took IMAGES: ms until `pile` has shown so many, from the command on
took() {
  local start
  start=$(now)
  "$tumble" view pile --images "$1" >log 2>&1
  echo $(($(now) - start))
}
took 1 >/dev/null  # what the driver compiles is kept
first=$(took 1)
echo "time until the first picture of pile, from the command on: $first ms"
echo "time of an image of pile, while it is simulated: $((($(took 201) - first) / 200)) ms"
exit $status
