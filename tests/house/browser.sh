# What the checks of pages share; to be sourced. Ends with 77 without a browser.
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
  { echo "$(basename "$0" .sh): skipped, there is no chromium"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# said FILE WIDTH,HEIGHT: what a page that drives itself says in its <pre id="said">. A browser that says nothing at all
# tells nothing of the page: it is asked again.
said() {
  local words='' try
  for try in 1 2 3 4 5 6; do
    [[ -n $words ]] && break
    words=$("$browser" --headless --no-sandbox --disable-gpu-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
      --hide-scrollbars --window-size="$2" --force-device-scale-factor=1 --virtual-time-budget=60000 \
      --user-data-dir="$(mktemp -d -p "$scratch")" --dump-dom "file://$1" 2>/dev/null |
      sed -n 's/.*<pre id="said">\(.*\)<\/pre>.*/\1/p' || true)
  done
  echo "$words"
}
