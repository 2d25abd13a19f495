#!/usr/bin/env bash
# Checks that the key reference of the manual equals the output of the program.
# Usage: scripts/check_keys.sh GEM
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
page=gem/manual/keys.md
if ! "$1" case explain --markdown | diff -u "$page" -; then
  echo "keys: $page is out of date (lines with + are new); update it with: $1 case explain --markdown > $page"
  exit 1
fi
echo "keys: $page equals the output of the program"
