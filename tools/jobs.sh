#!/usr/bin/env bash
# How many compilers to run at once: one per core, but each may need 2.5 GB (units of 40 sources, Eigen).
set -euo pipefail
cores=$(nproc)
by_memory=$(awk '/MemAvailable/ { print int($2 / 2.5e6) }' /proc/meminfo)
jobs=$((cores < by_memory ? cores : by_memory))
echo $((jobs > 0 ? jobs : 1))
