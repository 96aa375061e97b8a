#!/usr/bin/env bash
# All set-up, everything built, every test. Further arguments go to ctest, e.g. -R rotor.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh --tests
cmake --preset release
cmake --build --preset release -j "$(tools/jobs.sh)"
ctest --preset release -j2 "$@"
