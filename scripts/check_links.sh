#!/usr/bin/env bash
# Checks that every relative link of every page (*.md) points to a file, and every #anchor to a heading of its page. Checks
# too that every script that any file names with its folder exists; a line that names a commit may name one that is gone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Headings of a page as anchors: lower case, without punctuation, blanks as hyphens.
anchors() {
  sed -n '/^```/,/^```/d; s/^#\{1,6\} //p' "$1" | tr '[:upper:]' '[:lower:]' |
    sed 's/[^a-z0-9 _-]//g; s/ /-/g'
}

# Links of a page outside code: the target between ]( and ).
links() {
  sed '/^```/,/^```/d; s/`[^`]*`//g' "$1" | grep -oE '\]\([^)[:space:]]+\)' | sed 's/^](//; s/)$//' || true
}

faults=0 count=0
mapfile -t pages < <(find . -name '*.md' -not -path './build*' -not -path './.git/*' | sort)
for page in "${pages[@]}"; do
  while IFS= read -r link; do
    case $link in
      '' | http://* | https://* | mailto:*) continue ;;
    esac
    count=$((count + 1))
    target=${link%%#*}
    anchor=${link#"$target"}
    file=$page
    [ -z "$target" ] || file=$(dirname "$page")/$target
    if [ ! -e "$file" ]; then
      echo "${page#./}: no file for the link $link"
      faults=$((faults + 1))
    elif [ -n "$anchor" ] && [[ $file == *.md ]] && ! grep -qxF -- "${anchor#\#}" < <(anchors "$file"); then
      echo "${page#./}: no heading for the link $link"
      faults=$((faults + 1))
    fi
  done < <(links "$page")
done

# file:line:text of each line that names a script
named() {
  grep -rnIE '(scripts|bench)/[A-Za-z0-9_/-]+\.(sh|py|awk)\b' ./*.md ./*.txt scripts bench gem validation baseline_box2d \
    --exclude=CHANGELOG.md --exclude-dir=results --exclude-dir=__pycache__ | grep -v ' commit '
}
scripts=0
while IFS=: read -r file line text; do
  while IFS= read -r script; do
    scripts=$((scripts + 1))
    [ -e "$script" ] || { echo "${file#./}:$line: no script $script" && faults=$((faults + 1)); }
  done < <(grep -oE '\b(scripts|bench)/[A-Za-z0-9_/-]+\.(sh|py|awk)\b' <<<"$text")
done < <(named)
[ "$scripts" -gt 0 ] || { echo "links: no script is named (the check is broken)"; exit 1; }

[ "$count" -gt 0 ] || { echo "links: none found (the check is broken)"; exit 1; }
echo "links: $count in ${#pages[@]} pages, $scripts names of scripts, $faults faults"
[ "$faults" -eq 0 ]
