# Two Markdown tables from claims.txt and the rows of results: claims with their status, then each case with the row
# that uses most of its tolerance (of equals the first). Results: id,key,engine,resolution,expected,computed,error,tolerance,unit,verdict.
function used(error, tolerance) { return error == 0 ? 0 : (tolerance > 0 ? error / tolerance : 1e300) }

BEGIN { FS = "|"; numbers = 99 }

FNR == NR {
  if ($0 ~ /^#/ || NF < 4) next
  ++claims
  for (i = 1; i <= 4; ++i) gsub(/^ +| +$/, "", $i)
  claim[claims] = $2; test[claims] = $3; why[claims] = $4
  count = split($1, names, " ")
  for (i = 1; i <= count; ++i) owner[names[i]] = claims
  ids[claims] = $1
  next
}

FNR == 1 { FS = ","; $0 = $0 }

{
  id = $1
  if (!(id in owner)) { print "verification_table: case " id " has no claim in claims.txt" > "/dev/stderr"; exit 1 }
  if ($10 == "not offered") { ++absent[owner[id]]; ++absent_case[id]; next }
  ++checks[owner[id]]; ++checks_case[id]
  if ($10 != "pass") { ++faults[owner[id]]; ++faults_case[id] }
  if (!(id in worst) || used($7, $8) > worst[id]) { worst[id] = used($7, $8); row[id] = $0 }
}

END {
  print "\n### Claims\n"
  print "| cases | claim | test | tolerance and why | status |"
  print "|---|---|---|---|---|"
  for (c = 1; c <= claims; ++c) {
    if (!checks[c]) status = absent[c] ? "none" : "**not run**"
    else if (faults[c]) status = "**" faults[c] " of " checks[c] " fail**"
    else status = checks[c] " pass"
    if (absent[c]) status = status ", " absent[c] " not offered"
    print "| " ids[c] " | " claim[c] " | `" test[c] "` | " why[c] " | " status " |"
  }
  print "\n### Cases\n"
  print "Of each case the one number, over all engines and resolutions, that uses most of its tolerance; of equals the first.\n"
  print "| case | number | where | expected | computed | error | tolerance | unit | checks |"
  print "|---|---|---|---|---|---|---|---|---|"
  for (i = 1; i <= 2 * numbers; ++i) {
    id = i <= numbers ? sprintf("V%02d", i) : "M" (i - numbers)
    if (!(id in owner)) continue
    if (!(id in row)) {
      print "| " id " | | | | | | | | " (absent_case[id] ? absent_case[id] " not offered" : "**not run**") " |"
      continue
    }
    split(row[id], f, ",")
    where = f[4] == "-" ? f[3] : f[3] " " f[4]
    verdict = faults_case[id] ? "**" faults_case[id] " of " checks_case[id] " fail**" : checks_case[id] " pass"
    if (absent_case[id]) verdict = verdict ", " absent_case[id] " not offered"
    print "| " id " | " f[2] " | " where " | " f[5] " | " f[6] " | " f[7] " | " f[8] " | " f[9] " | " verdict " |"
  }
}
