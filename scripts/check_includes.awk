# The rules of check_includes.sh. Comments and string literals are removed before anything is searched.

BEGIN {
  # A layer sees itself and the layers before it; run and command are one rank.
  split("base geometry events scene field engine record analysis report view export film command", order, " ")
  for (i in order) rank[order[i]] = i + 0
  rank["run"] = rank["command"]
  rank["main"] = rank["command"] + 1
  rank["fuzz"] = rank["main"]

  # Headers of a third party and the only places that may include them.
  confined["cuda"] = "^(cuda|cub/|thrust/|cooperative_groups|device_launch|curand|nvtx)"
  home["cuda"] = "^(gem/engine|bench)/.*[.](cu|cuh)$"
  confined["toml"] = "^toml[+][+]/"
  home["toml"] = "^gem/scene/"
  confined["hdf5"] = "^(hdf5|H5)"
  home["hdf5"] = "^gem/record/"
  confined["gsl"] = "^gsl/"
  home["gsl"] = "^(gem|validation/paper)/analysis/"
  confined["eigen"] = "^(Eigen|eigen3)/"
  home["eigen"] = "^gem/engine/reference/"
  confined["box2d"] = "^box2d/"
  home["box2d"] = "^baseline_box2d/"
  confined["httplib"] = "^httplib[.]h"
  home["httplib"] = "^gem/view/server/"
  confined["zlib"] = "^zlib[.]h"
  home["zlib"] = "^gem/view/pack/"
  confined["cli11"] = "^CLI/"
  home["cli11"] = "^gem/(main[.]cpp$|command/)"

  # Words that are calls of these functions, whole words only.
  parsing = " strtod strtof strtold stod stof stold atof scanf sscanf fscanf "
  # Everything but + - * / sqrt may differ by a bit between two mathematics libraries.
  inexact = " sin cos tan sincos asin acos atan atan2 sinh cosh tanh pow hypot exp exp2 expm1 log log2 log10 log1p cbrt lgamma tgamma erf "
  device = " __global__ __device__ __host__ __shared__ __CUDACC__ __CUDA_ARCH__ __syncthreads "

  count = split(ENVIRON["ALLOWANCES"], lines, "\n")
  for (i = 1; i <= count; i++) {
    if (split(lines[i], part, " ") < 4) continue
    allowed[part[1] " " part[2] " " part[3]] = 1
  }
}

function report(rule, word, text) {
  if ((FILENAME " " rule " " word) in allowed) {
    used[FILENAME " " rule " " word] = 1
    return
  }
  printf "%s:%d: %s: %s\n", FILENAME, FNR, rule, text
  faults++
}

# The layer of a path under gem/: its folder, or the file's name if it lies directly in gem/.
function layer_of(path, parts, n) {
  n = split(path, parts, "/")
  if (n > 2) return parts[2]
  sub(/_test$/, "", parts[2])
  sub(/[.].*$/, "", parts[2])
  return parts[2]
}

# A line without comments and without the content of literals. `in_comment` and `raw_end` persist from line to line.
function code_of(line, out, i, c, two, at) {
  out = ""
  for (i = 1; i <= length(line); i++) {
    c = substr(line, i, 1)
    two = substr(line, i, 2)
    if (raw_end != "") {
      at = index(substr(line, i), raw_end)
      if (!at) break
      i += at + length(raw_end) - 2
      raw_end = ""
    } else if (in_comment) {
      if (two == "*/") {
        in_comment = 0
        i++
      }
    } else if (two == "/*") {
      in_comment = 1
      i++
    } else if (two == "//") {
      break
    } else if (two == "R\"") {
      at = index(substr(line, i), "(")
      raw_end = ")" substr(line, i + 2, at - 3) "\""
      i += at - 1
    } else if (c == "\"") {
      out = out "\"\""
      for (i++; i <= length(line) && substr(line, i, 1) != "\""; i++) if (substr(line, i, 1) == "\\") i++
    } else if (substr(line, i) ~ /^'([^\\']|\\.)'/) {
      i += substr(line, i + 1, 1) == "\\" ? 3 : 2
    } else {
      out = out c
    }
  }
  return out
}

function check_gem_include(target, theirs) {
  theirs = layer_of(target)
  # The reference engine judges the others: of the engines it knows what every engine offers.
  if (FILENAME ~ /^gem\/engine\/reference\// && !is_test && target ~ /^gem\/engine\// &&
      target !~ /^gem\/engine\/(engine[.]h$|reference\/)/)
    report("oracle", target, "the reference engine shares laws and geometry with the engines it judges, not \"" target "\"")
  if (target !~ /^gem\// || !(theirs in rank)) {
    report("unknown-layer", target, "\"" target "\" is not a path from the repository's root into a known layer")
    return
  }
  if (theirs == mine) return
  if (mine == "events" && theirs !~ /^(base|geometry)$/)
    report("events-sees", target, "events sees only base and geometry, not \"" target "\"")
  else if (mine == "analysis" && theirs !~ /^(base|record)$/)
    report("analysis-sees", target, "analysis sees only base and record, not \"" target "\"")
  else if (rank[theirs] > rank[mine])
    report("layer", target, mine " must not include \"" target "\", which stands above it")
}

function check_include(target, quoted, party) {
  for (party in confined)
    if (target ~ confined[party]) {
      if (FILENAME !~ home[party]) report(party, target, target " is not allowed here")
      return
    }
  if (target == "gem_version.h") return
  # Only the program knows that there are baselines.
  if (mine == "main" && target ~ /^baseline_box2d\//) return
  if (quoted && mine != "") check_gem_include(target)
}

function check_words(code, n, words, i, word, next_is_call) {
  # gem/base/strict_math.h computes the same functions from exact operations.
  gsub(/strict::[a-z0-9_]+/, "", code)
  gsub(/[^A-Za-z0-9_(]+/, " ", code)
  gsub(/[(]/, " ( ", code)
  n = split(code, words, " ")
  for (i = 1; i <= n; i++) {
    word = words[i]
    next_is_call = words[i + 1] == "("
    if (index(parsing, " " word " ")) report("locale", word, word " depends on the locale; use std::from_chars")
    # A test sets a foreign locale to show that nothing obeys it.
    if (!is_test && word == "setlocale") report("locale", word, "setlocale changes how libraries read numbers")
    if (exact_code && next_is_call && index(inexact, " " word " "))
      report("bits", word, word " is not exactly rounded, so engines may differ; use gem/base/strict_math.h")
    if (cuda_free && (index(device, " " word " ") || (word ~ /^cuda[A-Z]/)))
      report("cuda", word, word " belongs to *.cu and *.cuh of gem/engine and bench")
  }
}

# A stream may be split into lines and words, but `stream >> real` depends on the locale.
function check_streams(code, rest, name) {
  for (rest = code; match(rest, /(double|float)&? +[a-z_]+/); rest = substr(rest, RSTART + RLENGTH)) {
    name = substr(rest, RSTART, RLENGTH)
    sub(/.* /, "", name)
    reals[name] = 1
  }
  if (match(code, />> *[a-z_]+/)) {
    name = substr(code, RSTART, RLENGTH)
    sub(/>> */, "", name)
    if (name in reals) report("locale", name, ">> " name " depends on the locale; use std::from_chars")
  }
}

# Sums of doubles in an order chosen by the machine.
function check_order(code) {
  if (mine !~ /^(geometry|events|field|engine)$/) return
  if (code ~ /std::atomic<(double|float)>|std::atomic_ref<(double|float)>|atomicAdd *[(]/)
    report("order", "atomic", "an atomic sum has no fixed order; gather in id order")
  if (code ~ /#pragma omp atomic/) report("order", "omp_atomic", "an atomic sum has no fixed order; gather in id order")
  if (code ~ /#pragma omp .*reduction *[(] *[+*-]/)
    report("order", "reduction", "an OpenMP sum has no fixed order; sum over blocks of fixed size")
}

FNR == 1 {
  split("", reals)
  seen[FILENAME] = 1
  in_comment = 0
  raw_end = ""
  mine = FILENAME ~ /^gem\// ? layer_of(FILENAME) : ""
  is_test = FILENAME ~ /_test[.](cpp|cu)$/
  exact_code = !is_test && mine ~ /^(geometry|events|engine)$/
  cuda_free = FILENAME !~ home["cuda"] && FILENAME != "gem/base/macros.h"
  if (FILENAME ~ /^gem\// && !(mine in rank)) report("unknown-layer", mine, mine " is no layer of house rules")
}

{
  if (!in_comment && raw_end == "" && $0 ~ /^[ \t]*#[ \t]*include[ \t]*[<"]/) {
    target = $0
    sub(/^[ \t]*#[ \t]*include[ \t]*/, "", target)
    quoted = substr(target, 1, 1) == "\""
    target = substr(target, 2)
    sub(/[>"].*$/, "", target)
    check_include(target, quoted)
    next
  }
  code = code_of($0)
  check_words(code)
  check_streams(code)
  check_order(code)
}

END {
  for (key in allowed) {
    split(key, part, " ")
    if (part[1] in seen && !(key in used)) {
      printf "scripts/check_includes.sh:1: allowance: \"%s\" excuses nothing any more\n", key
      faults++
    }
  }
  printf "rules: %d files, %d faults\n", ARGC - 1, faults + 0
  exit faults > 0
}
