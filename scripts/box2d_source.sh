#!/usr/bin/env bash
# Fetches the sources of Debian's Box2D (2.4.1) and unpacks them, for a build that links Box2D statically. The package itself
# holds only a shared library, compiled with assertions.
# Needs apt and dpkg-source (package dpkg-dev). Changes nothing in the system.
# Usage: scripts/box2d_source.sh FOLDER      then: cmake --preset portable -DGEM_BOX2D_SOURCE=FOLDER/box2d-2.4.1
set -euo pipefail
[ $# -eq 1 ] || {
  echo "usage: scripts/box2d_source.sh FOLDER" >&2
  exit 2
}
mkdir -p "$1/apt/lists/partial"
cd "$1"
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
echo "deb-src http://deb.debian.org/debian $release main" >apt/sources.list
apt_here() {
  apt-get -qq -o Dir::Etc::SourceList="$PWD/apt/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o Dir::State::Lists="$PWD/apt/lists" "$@"
}
apt_here update
apt_here source --download-only box2d
rm -rf box2d-2.4.1
dpkg-source -x box2d_2.4.1-*.dsc box2d-2.4.1 >/dev/null
echo "$PWD/box2d-2.4.1"
