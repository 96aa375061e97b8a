#!/usr/bin/env bash
# All set-up and the main job: coil A3 breaks at 1500 rpm, is detected, the currents of the other
# coils are redistributed, the rotor stays up. Prints the timeline and where the report is.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh

name=coil_a3_opens_1500rpm
echo "build: ambrig (first time: a few minutes)"
cmake --preset release
cmake --build --preset release --target ambrig -j "$(tools/jobs.sh)"

verdict=0
build/release/ambrig run "scenarios/library/$name.toml" --out out || verdict=$?
if [ -e "out/$name.html" ]; then
  echo
  echo "The report:  $PWD/out/$name.html   (one file; any browser, no network needed)"
  echo "The record:  $PWD/out/$name.h5"
fi
cat <<'END'

Next:
  build/release/ambrig tour                                           three lessons, files included
  build/release/ambrig run scenarios/library/drop_at_1500rpm.toml     the rotor falls into its bearings
  build/release/ambrig hide sensor-gain --rig scenarios/library/rigs/reference.toml -o practice
                                                                      physics to find (docs/guide/hidden_effect.md)
  mkdir -p work && build/release/ambrig serve work                    the same in a browser: example rig, practice case
END
exit "$verdict"
