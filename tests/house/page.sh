#!/usr/bin/env bash
# Plays the page of a scene in a headless Chromium: no error, the images of the program within what is allowed,
# play, scrub, keys and drag by synthetic input. usage: page.sh BUILD_DIR; 77 without a browser
set -euo pipefail
house=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tumble=$(realpath "$1")/tumble
. "$house/browser.sh"

# Without what stands flat on the images; floor, bodies, light, shadows and arrows are compared.
bare=(--set show.title=false --set show.ruler=false --set show.path=false --set show.theory=false
  --set show.ladder=false --set image.size=[960,540])

status=0
check() {  # scene, instant [s], allowed share of pixels off by more than 16 levels [%], allowed mean [levels], bytes
  local page=$scratch/$1.html bytes
  "$tumble" render "$1" -q "${bare[@]}" --html "$page" --still "$2" -o "$scratch/$1"
  bytes=$(wc -c <"$page")
  {
    echo '<script>window.EXPECTED = "data:image/png;base64,'"$(base64 -w0 "$scratch/$1/still.png")"'";'
    echo "window.AT = $2;"
    cat "$house/page.js"
    echo '</script>'
    cat "$page"
  } >"$scratch/driven.html"
  awk -v scene="$1" -v said="$(said "$scratch/driven.html" 960,540)" -v share="$3" -v mean="$4" -v bytes="$bytes" -v most="$5" 'BEGIN {
    n = split(said, field, " "); ok = n == 5 && field[1] == "done" && field[2] + 0 <= share && field[3] + 0 <= mean && bytes <= most
    printf "%s page of %s, %d bytes (allowed %d): %s\n", ok ? "ok  " : "FAIL", scene, bytes, most,
      n == 5 && field[1] == "done" ? field[2] " % of pixels off by more than 16 (allowed " share "), mean " field[3] " (allowed " mean "), " field[4] " draws, drag " field[5] : said == "" ? "the page did not answer" : said
    exit !ok
  }' || status=1
}

check pile 4 1.0 0.6 500000  # measured 0.389 %, 0.287
exit $status
