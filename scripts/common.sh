# Shared by run.sh and test.sh: missing packages, configure and build, and the time of each phase. Sourced, not run.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
phase_times=()

say() { printf '[gem] %s\n' "$*"; }
fail() {
  printf '[gem] error: %s\n' "$*" >&2
  exit 1
}

# try_phase TITLE COMMAND...: announces and runs the command, and keeps its time for the final table. Returns its exit code.
try_phase() {
  local title=$1 start=$EPOCHREALTIME status=0
  shift
  say "$title ..."
  "$@" || status=$?
  local tenths=$(((${EPOCHREALTIME/[.,]/} - ${start/[.,]/}) / 100000))
  phase_times+=("$(printf '%8d.%d s  %s' $((tenths / 10)) $((tenths % 10)) "$title")")
  if [ "$status" -eq 0 ]; then
    say "$title: done in $((tenths / 10)).$((tenths % 10)) s"
  else
    say "error: '$title' failed (exit code $status); what it said is above" >&2
  fi
  return "$status"
}

# phase TITLE COMMAND...: the same, but a failure ends the script.
phase() { try_phase "$@" || exit 1; }

print_phase_times() {
  say "time of each phase:"
  printf '%s\n' "${phase_times[@]}"
}

# wanted_packages SET...: names in scripts/packages.txt of the given sets.
wanted_packages() {
  local set
  for set in "$@"; do awk -v set="$set" '!/^#/ && $2 == set { print $1 }' "$root/scripts/packages.txt"; done
}

# missing_packages SET...: the wanted packages that are not installed.
missing_packages() {
  local package
  for package in $(wanted_packages "$@"); do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
  done
}

# as_root COMMAND...: without a terminal nobody can type a password, so sudo must not ask for one.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif ! command -v sudo >/dev/null; then
    echo "this needs root and there is no sudo"
    return 1
  elif [ -t 2 ] && [ -z "${CI:-}" ]; then
    sudo "$@"
  else
    sudo -n "$@"
  fi
}

apt_install() {
  local log=$root/build/apt.log
  {
    as_root apt-get update -qq &&
      as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends -o Dpkg::Use-Pty=0 "$@"
  } </dev/null >"$log" 2>&1 && return
  tail -n 20 "$log" >&2
  say "install them by hand: apt-get install --no-install-recommends $*" >&2
  return 1
}

# install_missing SET...: installs only the missing packages.
install_missing() {
  mkdir -p "$root/build"
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "apt is not available: install the packages of scripts/packages.txt by hand; continuing with what is installed"
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages "$@")
  if [ "${#missing[@]}" -eq 0 ]; then
    say "all $(wanted_packages "$@" | wc -l) packages of set '$*' are installed"
    return
  fi
  say "packages of set '$*': ${#missing[@]} missing: ${missing[*]}"
  say "output of apt: $root/build/apt.log"
  phase "install packages" apt_install "${missing[@]}"
}

# program_only: options for a first configuration without the packages of set `test`; empty if tests are already built.
program_only() {
  grep -qs '^GEM_TESTS:BOOL=ON' "$root/build/CMakeCache.txt" || printf "%s\n" -DGEM_TESTS=OFF -DGEM_BENCHMARKS=OFF
}

# build_targets [-DOPTION...] [TARGET...]: builds the default preset in build/; all targets if none is named.
build_targets() {
  local options=() targets=()
  while [[ ${1:-} == -D* ]]; do
    options+=("$1")
    shift
  done
  [ "$#" -eq 0 ] || targets=(--target "$@")
  cd "$root" || fail "cannot enter $root"
  phase "configure" cmake --preset default --log-level=WARNING "${options[@]}"
  phase "build" cmake --build --preset default --parallel "$(nproc)" "${targets[@]}"
}
