# What the checks of pages share; to be sourced. Ends with 77 without a browser.
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
  { echo "$(basename "$0" .sh): skipped, there is no chromium"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# said FILE WIDTH,HEIGHT: what a page that drives itself tells the console as "said: …", within two minutes; else the end
# of what the browser wrote. The clock is the wall's: a virtual one runs out while decoders and the GPU's process work.
said() {
  local log=$scratch/browser.log words='' browserId tenths
  : >"$log"
  "$browser" --headless --no-sandbox --disable-gpu-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
    --hide-scrollbars --window-size="$2" --force-device-scale-factor=1 --enable-logging=stderr \
    --remote-debugging-port=0 --user-data-dir="$(mktemp -d -p "$scratch")" "file://$1" >"$log" 2>&1 &
  browserId=$!
  for ((tenths = 0; tenths < 1200; ++tenths)); do
    words=$(sed -n 's/.*"said: \(.*\)", source: .*/\1/p' "$log")
    [[ -z $words ]] && kill -0 $browserId 2>/dev/null || break
    sleep 0.1
  done
  kill $browserId 2>/dev/null || true
  wait $browserId 2>/dev/null || true
  echo "${words:-the page did not answer: $(tail -n 5 "$log" | tr '\n' ' ')}"
}
