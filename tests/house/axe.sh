#!/usr/bin/env bash
# Holds the gallery's page to the rules of axe-core (contrast, names, order of headings, …) in a headless
# Chromium. usage: axe.sh BUILD_DIR; 77 without a browser, npm or a network
set -euo pipefail
house=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tumble=$(realpath "$1")/tumble
version=4.10.3
. "$house/browser.sh"
command -v npm >/dev/null || { echo "axe: skipped, there is no npm"; exit 77; }

npm pack --silent --pack-destination "$scratch" "axe-core@$version" >/dev/null 2>&1 ||
  { echo "axe: skipped, axe-core $version cannot be had from npm; is there a network?"; exit 77; }
tar -xzf "$scratch/axe-core-$version.tgz" -C "$scratch" package/axe.min.js

# A page with panels, graphs, charts, claims, a sweep and slides.
"$tumble" gallery -q particles restitution-sweep soft-to-hard --set image.size=[320,180] -o "$scratch/out"

# Every picture, scene and table that the page names is there.
links=0 status=0
while read -r link; do
  links=$((links + 1))
  [[ -s $scratch/out/$link ]] || { echo "FAIL the page names $link, which is not there"; status=1; }
done < <(grep -oE '(href|src)="[^"#]+"' "$scratch/out/index.html" | sed 's/^[a-z]*="//; s/"$//' | sort -u)
((links > 15)) || { echo "FAIL only $links links"; status=1; }
[[ $status == 0 ]] && echo "ok   all $links links of the page lead to a file"

# Said as "done FINDINGS RULES", or what is wrong; each finding on the page at 1280 and at 360 px.
for width in 1280 360; do
  {
    cat "$scratch/out/index.html"
    echo '<script>'
    cat "$scratch/package/axe.min.js"
    echo "</script><script>window.WIDTH = $width;"
    cat "$house/axe.js"
    echo '</script>'
  } >"$scratch/out/driven.html"
  answer=$(said "$scratch/out/driven.html" 1280,900)
  if [[ $answer == "done 0 "* ]]; then
    echo "ok   gallery at $width px: no finding by ${answer#done 0 } rules of axe-core $version"
  else
    echo "FAIL gallery at $width px: $answer"
    status=1
  fi
done
exit $status
