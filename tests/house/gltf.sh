#!/usr/bin/env bash
# Holds glTF files of runs to Khronos' validator: no error, no warning. usage: gltf.sh BUILD_DIR; 77 without node, npm or
# a network
set -euo pipefail
tumble=$(realpath "$1")/tumble
version=2.0.0-dev.3.10
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
command -v npm >/dev/null && command -v node >/dev/null || { echo "gltf: skipped, there is no npm"; exit 77; }
cd "$scratch"
npm install --silent --no-audit --no-fund "gltf-validator@$version" >/dev/null 2>&1 ||
  { echo "gltf: skipped, gltf-validator $version cannot be had from npm; is there a network?"; exit 77; }

# Bodies of many forms; cloth, solids and strands.
for demo in pile rings drape jello brushed-fur; do
  "$tumble" export -q "$demo" -o "$demo.glb"
done
# What cannot be asked of it is the two extensions for physics, which it does not know.
cat >validate.js <<'END'
const validator = require('gltf-validator'), fs = require('fs');
(async () => {
  for (const file of process.argv.slice(2)) {
    const bytes = new Uint8Array(fs.readFileSync(file));
    const { issues } = await validator.validateBytes(bytes, { maxIssues: 100 });
    const said = issues.messages.filter(issue => issue.code !== 'UNSUPPORTED_EXTENSION');
    for (const issue of said.slice(0, 5)) console.log(`     ${issue.code} ${issue.pointer}: ${issue.message}`);
    console.log(`${said.length ? 'FAIL' : 'ok  '} ${file}: ${bytes.length} bytes, ${said.length} remarks`);
    if (said.length) process.exitCode = 1;
  }
})();
END
node validate.js ./*.glb
