#!/usr/bin/env bash
# Checks that a program built with GEM_STATIC needs only the C library, its mathematics library and the loader.
# Usage: scripts/check_portable.sh PROGRAM
set -euo pipefail
needed=$(objdump -p "$1" | awk '$1 == "NEEDED" { print $2 }')
foreign=$(grep -vE '^(libc|libm|ld-linux-x86-64)\.so\.[0-9]+$' <<<"$needed" || true)
if [ -n "$foreign" ]; then
  echo "$1 needs more than libc, libm and the loader: ${foreign//$'\n'/ }"
  exit 1
fi
echo "$1 needs only: ${needed//$'\n'/ }"
