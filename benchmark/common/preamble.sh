# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the shell scripts in this folder share; to be sourced. Sets root, build and results.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=build-benchmark
results=$root/benchmark/results
script=$(basename "$0")

# The comment at the head of the script, from its third line on.
usage() {
  awk 'NR > 3 && !/^#/ { exit } NR > 3 { sub(/^# ?/, ""); print }' "$0"
}

# Complaints end the script.
fail() {
  echo "$script: $*" >&2
  exit 1
}

unknown_option() {
  echo "$script: unknown option $1" >&2
  usage >&2
  exit 1
}

# The folder of the models as an absolute path.
models_folder() {
  [ -d "$1" ] || fail "there is no folder $1; benchmark/README.md says where the models come from"
  realpath "$1"
}

# A readable file as an absolute path.
input_file() {
  [ -r "$1" ] || fail "can't read $1"
  realpath "$1"
}

# Builds programs in the root folder, and makes the folder of results.
build_programs() {
  cd "$root"
  cmake --preset release -B "$build" -D WEFT_BUILD_BENCHMARKS=ON >&2
  cmake --build "$build" --target "$@" >&2
  mkdir -p "$results"
}

# The last line of the tables: when and where.
print_machine() {
  printf '\n%s, %s, %s processors\n' "$(date -u +%Y-%m-%d)" \
    "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1)" "$(nproc)"
}
