# shellcheck shell=sh
# Distributes work among several processes of one machine, in plain sh. Sourced, not run.
#
# Environment: GEM_DEADLINE, time in seconds since 1970. Nothing is started after it, and `limited` ends running commands.
#              GEM_CORES="0,16 1,17" processors of each worker: `limited` keeps its commands on them (needs taskset)
#
# in_parallel JOBS LIST DONE FUNCTION: calls FUNCTION with each line of the file LIST, JOBS at a time. A line is skipped if
# DONE/NAME exists (NAME: its first field, up to a tab), so a stopped run can continue. FUNCTION creates that file last. A
# failed call is reported, and its line is tried again next time.
in_parallel() {
  [ "$1" -ge 1 ] 2>/dev/null || {
    echo "jobs: '$1' is not a number above 0" >&2
    exit 2
  }
  taken=$3/taken.$$
  mkdir -p "$3" "$taken"
  worker=0
  while [ "$worker" -lt "$1" ]; do
    worker=$((worker + 1))
    worker_loop "$2" "$3" "$4" "$taken" "$worker" &
  done
  wait
  rm -rf "$taken"
}

seconds_left() {
  if [ -n "${GEM_DEADLINE:-}" ]; then echo $((GEM_DEADLINE - $(date +%s))); else echo 1000000; fi
}

# limited COMMAND...: ended at the deadline, on the processors of its worker
limited() {
  cores=$(echo "${GEM_CORES:-}" | cut -d' ' -f"${worker:-1}")
  [ -z "$cores" ] || set -- taskset -c "$cores" "$@"
  if [ -n "${GEM_DEADLINE:-}" ]; then
    left=$(seconds_left)
    timeout "$((left > 0 ? left : 1))" "$@"
  else
    "$@"
  fi
}

worker_loop() {
  tab=$(printf '\t')
  worker=$5
  while IFS= read -r line; do
    name=${line%%"$tab"*}
    [ ! -e "$2/$name" ] || continue
    [ "$(seconds_left)" -gt 0 ] || break
    mkdir "$4/$name" 2>/dev/null || continue # another worker has it
    "$3" "$line" </dev/null || echo "failed: $name" >&2
  done <"$1"
}
