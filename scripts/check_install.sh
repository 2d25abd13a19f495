#!/usr/bin/env bash
# Installs a build into a new prefix, moves it, and uses it from there: the program, its pages, its cases, and the example of a
# program on the library. Usage: scripts/check_install.sh BUILD CMAKE CXX
set -euo pipefail
build=$1 cmake=$2 compiler=$3
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
  echo "check_install: $*" >&2
  exit 1
}

"$cmake" --install "$build" --prefix "$folder/first" >"$folder/log" 2>&1 || fail "$(tail -3 "$folder/log")"
mkdir "$folder/some where"
mv "$folder/first" "$folder/some where/moved"
prefix="$folder/some where/moved"
gem="$prefix/bin/gem"

# The installed files are found where they are now, and nothing names the places of the build. Debug information and the reports of
# sanitizers name the sources, so builds with them may.
"$gem" --version --json | grep -qF "\"installed_files\": \"$prefix/share/gem\"" || fail "gem does not find its files"
grep -qE '^(CMAKE_BUILD_TYPE:[A-Z]+=(Debug|RelWithDebInfo)|GEM_SANITIZE:[A-Z]+=.+)$' "$build/CMakeCache.txt" ||
  ! grep -rlF -e "$source" -e "$build" -e "$folder/first" "$prefix" || fail "the files above name folders of the build"
case="$prefix/share/gem/cases/analytic/V10_floe_on_moored_platform.toml"
(cd "$folder" && "$gem" run "$case" --threads 1 --quiet --out run.h5 && "$gem" info run.h5 --json >info.json)
gzip -dc "$prefix/share/man/man1/gem.1.gz" | grep -q '^\.TH GEM 1' || fail "no manual page"
bash -c "source '$prefix/share/bash-completion/completions/gem' && complete -p gem" >/dev/null || fail "no completion"

# Libraries for development are not part of a static build.
[ -d "$prefix/include/gem" ] || exit 0
# Uses the generator of the build; make may be missing.
generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$build/CMakeCache.txt")
"$cmake" -S "$source/gem/manual/examples/consumer" -B "$folder/consumer" -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
"$cmake" --build "$folder/consumer" >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
said=$("$folder/consumer/largest_load" "$case")
echo "$said"
[[ $said =~ ^"largest ice force "[1-9] ]] || fail "no load"
hash=${said##* }
grep -qF "\"gem_state_hash\": \"$hash\"" "$folder/info.json" || fail "another state hash than that of gem run"
! "$folder/consumer/largest_load" missing.toml 2>"$folder/log" || fail "a missing case is no error"
grep -q 'missing.toml' "$folder/log" || fail "the error does not name the case"
