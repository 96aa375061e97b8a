#!/usr/bin/env bash
# All set-up, everything built, every test, and the tests of core (readers of all formats) once more under the address and
# undefined-behaviour sanitizers.
# Further arguments go to ctest, e.g. -R rotor; with them nothing runs under the sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh --tests
cmake --preset release
cmake --build --preset release -j "$(tools/jobs.sh)"
ctest --preset release -j3 "$@"
[ $# -eq 0 ] || exit 0
echo "the tests of core under the sanitizers"
cmake --preset asan
cmake --build --preset asan --target fast_tests -j "$(tools/jobs.sh)"
ctest --preset asan -L fast -j3
