#!/usr/bin/env bash
# Runs a command of the browser tests in this folder; 77, which CTest counts as skipped, where what
# they need is not there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
skip() {
  echo "skipped: $1"
  exit 77
}
{ command -v chromium-headless-shell || command -v chromium; } >/dev/null ||
  skip 'neither chromium-headless-shell nor chromium is installed; the reports are not opened'
command -v node >/dev/null || skip 'node is not installed; the reports are not opened'
[[ -d node_modules/playwright-core ]] ||
  skip 'playwright-core is not there (npm ci in tests/browser); the reports are not opened'
exec "$@"
