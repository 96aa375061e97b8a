#!/usr/bin/env bash
# Installs what ambrig needs on a Debian 12 machine; run again at will, the second time takes a second.
#
#   tools/setup.sh            compiler, libraries, the plotting library of the reports
#   tools/setup.sh --tests    also what only tests use: Chromium (renders a report), Slurm (campaigns), a validator of JSON
#   tools/setup.sh --tidy     also clang-format, clang-tidy (preset `tidy`) and clang's syntax trees (tools/mutate.py)
#   tools/setup.sh --fuzz     also clang with libFuzzer (preset `fuzz`)
#   tools/setup.sh --python   also what the Python module and its tests need (preset `python`)
#
# Needs root, or sudo, and only when a package is missing.
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(
  g++ cmake ninja-build pkg-config git ca-certificates python3 ccache
  libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libfmt-dev libpugixml-dev libzip-dev  # files, commands
  libhdf5-dev hdf5-tools libmatio-dev zlib1g-dev                                 # records
  libeigen3-dev liblapack-dev libslicot-dev libsundials-dev libode-dev           # physics
  libceres-dev libnlopt-dev libnlopt-cxx-dev libmuparser-dev                     # fits, formulas
  libtbb-dev librandom123-dev                                                    # threads, noise
  libmicrohttpd-dev                                                              # workbench
  libgtest-dev libgmock-dev libbenchmark-dev                                     # tests, bench
)
for option in "$@"; do
  case "$option" in
    --tests) packages+=(chromium slurm-wlm slurm-wlm-basic-plugins munge python3-jsonschema) ;;
    --python) packages+=(python3-dev pybind11-dev python3-pip python3-setuptools python3-wheel python3-numpy
                         python3-matplotlib python3-scipy python3-xarray mypy                       # tests
                         python3-nbformat python3-nbclient python3-ipykernel) ;;                    # notebooks
    --tidy) packages+=(clang-format clang-tidy-16 python3-clang-16) ;;
    --fuzz) packages+=(clang-16 libclang-rt-16-dev) ;;
    -h | --help) sed -n '2,10s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) echo "setup: unknown option $option (allowed: --tests, --tidy, --fuzz, --python)" >&2; exit 2 ;;
  esac
done
# A Node.js that is already there, from wherever, is as good as Debian's.
command -v npm > /dev/null || packages+=(nodejs npm)

as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo > /dev/null; then
    sudo "$@"
  else
    echo "setup: packages are missing (${missing[*]}); run as root, or install sudo" >&2
    exit 1
  fi
}

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$state" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  echo "setup: installing ${#missing[@]} packages: ${missing[*]}"
  as_root apt-get update -q
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends "${missing[@]}"
fi

# npm ci leaves its own note of what it installed; older than ours means out of date.
installed=web/node_modules/.package-lock.json
if [ ! -e "$installed" ] || [ web/package.json -nt "$installed" ] ||
   [ web/package-lock.json -nt "$installed" ]; then
  echo "setup: fetching the libraries of the pages (npm, web/package.json)"
  npm ci --prefix web --no-audit --no-fund --loglevel=error
  touch "$installed"
fi
echo "setup: everything is there"
