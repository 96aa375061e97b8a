#!/usr/bin/env bash
# What takes hours: everything under the sanitizers, clang-tidy over every file, the fuzz targets, the slow blocks of the docs.
#
#   tools/nightly.sh                     all of it, in build/nightly/*.log; ends with a table, exit code 1 where a step failed
#   tools/nightly.sh asan fuzz           only these: release asan tsan tidy fuzz files scenarios docs
#   RUNS=20000 tools/nightly.sh fuzz     fewer executions (10^6 of each target where it is not given)
set -uo pipefail
cd "$(dirname "$0")/.."
logs=build/nightly
jobs=$(tools/jobs.sh)
runs=${RUNS:-1000000}
all=(release asan tsan tidy fuzz files scenarios docs)

build() { cmake --preset "$1" && cmake --build --preset "$1" -j "$jobs"; }

run_step() {
  case "$1" in
    release) build release && AMBRIG_SLOW_TESTS=1 ctest --preset release -j "$jobs" ;;
    asan) build asan && ctest --preset asan -j "$jobs" -E "workbench_walk|workbench_budgets|docs_|planted_change" ;;
    tsan) build tsan && ctest --preset tsan -R 'Threads|Jobs|SameB|Determinism|Serve|EventLog|RecordReader|Campaign|Journal' ;;
    tidy) build tidy ;;
    fuzz) build fuzz && python3 tools/fuzz_readers.py --runs "$runs" --jobs "$jobs" ;;
    files) build asan && python3 tools/fuzz.py build/asan/ambrig --runs "$((runs / 500))" ;;
    scenarios) build release && python3 tools/random_scenarios.py build/release/ambrig -n "$((runs / 10))" -j "$jobs" ;;
    docs) build release && AMBRIG_SLOW_TESTS=1 ctest --preset release -R docs_ ;;
    *) echo "nightly: unknown step $1 (allowed: ${all[*]})" >&2; return 2 ;;
  esac
}

case "${1:-}" in -h | --help) sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
steps=("$@")
[ $# -gt 0 ] || steps=("${all[@]}")
for step in "${steps[@]}"; do
  [[ " ${all[*]} " == *" $step "* ]] || { echo "nightly: unknown step $step (allowed: ${all[*]})" >&2; exit 2; }
done
tools/setup.sh --tests --tidy --fuzz
mkdir -p "$logs"
failed=0
for step in "${steps[@]}"; do
  begin=$SECONDS
  echo "nightly: $step begins, $logs/$step.log"
  if run_step "$step" > "$logs/$step.log" 2>&1; then verdict=passed; else verdict=FAILED; failed=1; fi
  printf '%-10s %-6s %5d s\n' "$step" "$verdict" "$((SECONDS - begin))" | tee -a "$logs/summary.txt"
done
exit "$failed"
