#!/usr/bin/env bash
# Adds the manual's example of a law to a copy of the tree, as a reader would, and runs its tests there. They judge it by
# closed form on every engine, and by the state hash of a case that does not use it: that of GEM, which is without the law.
# The patch may touch the list of laws and that of sections, and no other file. FOLDER keeps what was compiled.
# Usage: scripts/check_example_law.sh GEM FOLDER EXAMPLE
set -euo pipefail
gem=$1 folder=$2 example=$(cd "$3" && pwd)
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
tree=$folder/tree
law=$(basename "$example")

touched=$(sed -n 's,^+++ b/\([^[:space:]]*\).*,\1,p' "$example/$law.patch")
allowed=$'gem/events/events.h\ngem/scene/schema/sections/sections.h'
if [ "$touched" != "$allowed" ]; then
  printf 'a law changes\n%s\nand no other file; %s.patch changes\n%s\n' "$allowed" "$law" "$touched"
  exit 1
fi

# times are kept, so that only what changed since the last run is compiled
rm -rf "$tree"
mkdir -p "$tree/scripts" "$tree/validation/verification"
cp -rp "$root/gem" "$tree"
cp -rp "$root/scripts/cmake" "$tree/scripts"
patch --strip=1 --directory="$tree" --no-backup-if-mismatch <"$example/$law.patch"
for file in $touched; do
  newest=$root/$file
  [ "$example/$law.patch" -nt "$newest" ] && newest=$example/$law.patch
  touch -r "$newest" "$tree/$file"
done
cp -p "$example/$law.h" "$example/${law}_test.cpp" "$tree/gem/events"
cp -p "$example/${law}_keys.cpp" "$tree/gem/scene/schema/sections/$law.cpp"
cp -p "$example/${law}_scene_test.cpp" "$tree/validation/verification"

# the rules of who includes whom hold for its files
rm -rf "$folder/rules"
for file in gem/events/{events.h,"$law".h,"${law}_test.cpp"} gem/scene/schema/sections/{sections.h,"$law".cpp} \
  validation/verification/"${law}_scene_test.cpp"; do
  mkdir -p "$(dirname "$folder/rules/$file")"
  cp "$tree/$file" "$folder/rules/$file"
done
"$root/scripts/check_includes.sh" "$folder/rules"

# the manual shows lines of this patch and no others
shown=$(awk '/^```diff/ { on = 1; next } /^```/ { on = 0 } on' "$root/gem/manual/architecture.md")
[ -n "$shown" ] || { echo "gem/manual/architecture.md shows no diff" && exit 1; }
others=0 # status of grep: 0 there are other lines, 1 there are none, 2 it could not look
grep -Fxv -f "$example/$law.patch" <<<"$shown" || others=$?
if [ "$others" -ne 1 ]; then
  echo "gem/manual/architecture.md shows these lines as part of $law.patch, which has others"
  exit 1
fi

cmake -S "$example/.." -B "$folder/build" -G Ninja -DTREE="$tree" -DLAW="$law" --log-level=WARNING >"$folder/cmake.log"
cmake --build "$folder/build" --parallel 2

CASE_WITHOUT_LAW=$(echo "$example"/*.toml)
HASH_WITHOUT_LAW=$("$gem" run "$CASE_WITHOUT_LAW" --out "$folder/without.h5" --overwrite | awk '/state hash/ { print $3 }')
export CASE_WITHOUT_LAW HASH_WITHOUT_LAW
"$folder/build/law_test"
