#!/usr/bin/env bash
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Fuzzes everything that is read, with the programs that `cmake --preset fuzz && cmake --build --preset fuzz` makes.
#
#   test/fuzz/run.sh --runs 20000           so many executions of each program, the same ones every time
#   test/fuzz/run.sh --minutes 60           so long each, with other random numbers every time
#   test/fuzz/run.sh --minutes 60 obj log   only these of obj off ply stl glb gltf log progressive
#
# Starts from test/fuzz/seeds. With --minutes it goes on from what earlier runs have found worth keeping, in
# build/fuzz/corpus. Ends with status 1 when a program stopped, by a crash, a broken promise, a hang of 20 seconds, or an
# allocation of 256 MiB; the file that stopped it is then in build/fuzz/found. Mend the reader, and put the file among the
# seeds, where mesh_files_seeds_test sees it for good; a file that must be refused has a name that begins with "refused".
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

case "${1:-}" in
  --runs) limit=(-runs="$2" -seed=1) runs_for_a_time=no ;;
  --minutes) limit=(-max_total_time="$((60 * $2))") runs_for_a_time=yes ;;
  *)
    echo "usage: test/fuzz/run.sh --runs NUMBER | --minutes NUMBER [KIND...]" >&2
    exit 2
    ;;
esac
kinds=("${@:3}")
if [[ ${#kinds[@]} == 0 ]]; then
  kinds=(obj off ply stl glb gltf log progressive)
fi

# Every mesh that is read is written: in memory, if there is a file system there.
if [[ -z "${TMPDIR:-}" && -w /dev/shm ]]; then
  export TMPDIR=/dev/shm
fi
mkdir -p build/fuzz/found

# Runs the program of one kind, and says in a line how it went.
fuzz() {
  local kind=$1 corpus log=build/fuzz/found/$1.log status=0
  if [[ $runs_for_a_time == yes ]]; then
    corpus=build/fuzz/corpus/$kind
    mkdir -p "$corpus"
  else
    corpus=$(mktemp -d)
  fi
  if build/fuzz/test/fuzz/fuzz_"$kind" "$corpus" test/fuzz/seeds/"$kind" "${limit[@]}" -dict=test/fuzz/words.dict \
    -max_len=4096 -timeout=20 -rss_limit_mb=1024 -malloc_limit_mb=256 -print_final_stats=1 \
    -artifact_prefix=build/fuzz/found/"$kind"- >"$log" 2>&1; then
    echo "$kind: $(sed -n 's/stat::number_of_executed_units: *//p' "$log") executions, nothing found"
  else
    status=1
    echo "$kind: stopped, see $log" >&2
    tail -n 20 "$log" >&2
  fi
  if [[ $runs_for_a_time == no ]]; then
    rm -r "$corpus"
  fi
  return $status
}

# One program for each processor at a time.
status=0
running=0
for kind in "${kinds[@]}"; do
  if ((running == $(nproc))); then
    wait -n || status=1
    running=$((running - 1))
  fi
  fuzz "$kind" &
  running=$((running + 1))
done
for ((; running > 0; --running)); do
  wait -n || status=1
done
exit $status
