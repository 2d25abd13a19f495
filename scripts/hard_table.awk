# A Markdown table of the hard cases from their rows: each bound, and what every engine and resolution came to.
# Rows: id,key,engine,resolution,expected,computed,error,tolerance,unit,verdict. A bound that is missed is bold; a miss
# that is stated beforehand carries its number in known_misses.txt, read first.
BEGIN { FS = "|"; settings = 0 }

FNR == NR {
  if ($0 ~ /^#/ || NF < 2) next
  gsub(/^ +| +$/, "", $1); gsub(/^ +| +$/, "", $2)
  split($1, name, " ")
  why[name[1] "," name[2]] = $2
  next
}

FNR == 1 { FS = ","; $0 = $0 }

{
  key = $2
  setting = $4 == "-" ? $3 : $3 " " $4
  if (!(setting in column)) { column[setting] = ++settings; heading[settings] = setting }
  if (!(key in seen)) { seen[key] = ++keys; named[keys] = key; expected[key] = $5; bound[key] = $8; unit[key] = $9 }
  value = sprintf("%.3g", $6) ($8 == bound[key] ? "" : " (bound " $8 ")")
  if ($10 == "FAIL") { value = "**" value "**"; ++failed[key] }
  if ($10 == "missed") {
    reason = why[$4 "," key]
    if (!(reason in note)) { note[reason] = ++notes; text[notes] = reason }
    value = "*" value "* (" note[reason] ")"
  }
  cell[key, setting] = value
  ++count[$10]
}

# H2 stands before H10: letter, number, rest
function sort_key(key) { match(key, /[0-9]+/); return sprintf("%s%04d%s", substr(key, 1, 1), substr(key, RSTART, RLENGTH), substr(key, RSTART + RLENGTH)) }

END {
  printf "\n%d numbers within their bounds, %d beyond, %d stated as missed.\n\n", count["pass"], count["FAIL"], count["missed"]
  line = "| number | expected | bound | unit |"; rule = "|---|---|---|---|"
  for (s = 1; s <= settings; ++s) { line = line " " heading[s] " |"; rule = rule "---|" }
  print line; print rule
  for (i = 1; i <= keys; ++i) order[i] = sort_key(named[i]) "\t" named[i]
  for (i = 2; i <= keys; ++i)
    for (j = i; j > 1 && order[j - 1] > order[j]; --j) { swap = order[j]; order[j] = order[j - 1]; order[j - 1] = swap }
  for (i = 1; i <= keys; ++i) {
    split(order[i], parts, "\t"); key = parts[2]
    line = "| " key " | " expected[key] " | " bound[key] " | " unit[key] " |"
    for (s = 1; s <= settings; ++s) line = line " " cell[key, heading[s]] " |"
    print line
  }
  print ""
  for (n = 1; n <= notes; ++n) print n ". " text[n]
}
