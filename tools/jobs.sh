#!/usr/bin/env bash
# How many compilers to run at once: one per core, but each may need 1.5 GB (Ceres, Eigen).
set -euo pipefail
cores=$(nproc)
by_memory=$(awk '/MemAvailable/ { print int($2 / 1.5e6) }' /proc/meminfo)
jobs=$((cores < by_memory ? cores : by_memory))
echo $((jobs > 0 ? jobs : 1))
