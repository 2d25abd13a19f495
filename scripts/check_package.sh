#!/usr/bin/env bash
# Makes the Debian package of a build and checks it. Exit code 77: a tool is missing.
# Usage: scripts/check_package.sh BUILD [CPACK]         makes the package; lintian must find no error
#        scripts/check_package.sh --root DEB [FOLDER]   as root: installs DEB into a bare Debian 12 (debootstrap, a few minutes), runs it
set -euo pipefail
fail() {
  echo "check_package: $*" >&2
  exit 1
}
need() {
  for tool; do command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed" && exit 77; }; done
}

# What a user does first, in the bare root: no compiler, no sources.
try_in_root='set -e
absent() { if "$@"; then echo "should have failed: $*" >&2; exit 1; fi; }
absent command -v gcc cc c++ cmake
cd /root
gem --version --json
gem case explain current
gem run /usr/share/gem/cases/first.toml --until 300 --threads 1 --overwrite --out first.h5
gem info first.h5
gem analyse first.h5
gem report first.h5 --at 4min --out first_report
ls -l first_report/index.html first_report/figures/field_at.svg
gem run /usr/share/gem/cases/first.toml --until 300 --threads 1 --overwrite --quiet --set run.seed=2 --out second.h5
gem compare first.h5 second.h5 --out comparison
gem view first.h5 --out first.html
grep -q "gem view" first.html
# without ffmpeg a film is refused with a reason, and nothing is left
absent command -v ffmpeg
absent gem film first.h5 first.mp4 2>film_err
grep "ffmpeg was not found" film_err
absent ls first.mp4 .first.new.mp4 2>/dev/null'

if [ "$1" = --root ]; then
  deb=$(realpath "$2")
  need debootstrap
  folder=${3:-$(mktemp -d)/root}
  [ -d "$folder/bin" ] || debootstrap --variant=minbase bookworm "$folder" >"$folder.log" 2>&1 || fail "$(tail -3 "$folder.log")"
  # as on a machine: with /proc the program finds its installed files; without the right to mount, it does not
  ! mount -t proc proc "$folder/proc" 2>/dev/null || trap 'umount "$folder/proc"' EXIT
  cp "$deb" "$folder/root/gem.deb"
  chroot "$folder" apt-get install -y --no-install-recommends /root/gem.deb >"$folder.log" 2>&1 || fail "$(tail -5 "$folder.log")"
  chroot "$folder" env -i PATH=/usr/bin:/bin HOME=/root bash -c "$try_in_root"
  chroot "$folder" apt-get remove -y gem-pack-ice >"$folder.log" 2>&1 || fail "$(tail -5 "$folder.log")"
  ! ls -d "$folder"/usr/bin/gem "$folder"/usr/share/gem 2>/dev/null || fail "the files above stay after it was removed"
  echo "installed, run and removed in $folder"
  exit 0
fi

need dpkg-deb dpkg-shlibdeps lintian gzip
build=$(realpath "$1")
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
"${2:-cpack}" --config "$build/CPackConfig.cmake" -G DEB -B "$made" >"$made/log" 2>&1 || fail "$(tail -5 "$made/log")"
deb=$(echo "$made"/*.deb)
dpkg-deb -c "$deb" >"$made/files"
for file in usr/bin/gem usr/share/man/man1/gem.1.gz usr/share/bash-completion/completions/gem usr/share/gem/cases/first.toml \
  usr/share/doc/gem-pack-ice/copyright usr/share/doc/gem-pack-ice/manual/user_guide.md; do
  grep -qF " ./$file" "$made/files" || fail "$file is not in the package"
done
! grep -E ' \./usr/(include|lib)/' "$made/files" || fail "the files above are for development"
dpkg-deb -f "$deb" Depends | grep -q 'libhdf5.*' || fail "no dependencies on libraries"
# No report to Debian asked for this package, so none is closed by it.
lintian --fail-on error --suppress-tags initial-upload-closes-no-bugs "$deb" || fail "lintian finds the errors above"
echo "package $(basename "$deb"): no error"
