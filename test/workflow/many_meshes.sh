#!/usr/bin/env bash
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Runs what docs/many_meshes.md says on a small folder of meshes, three of which are broken: with Snakemake, interrupted and
# resumed; with GNU parallel; with the argument "slurm" also on a Slurm cluster of this one machine, which it starts (as root)
# and stops. On demand.
#
#   test/workflow/many_meshes.sh SELVEDGE [slurm]
set -euo pipefail
selvedge=$(realpath "$1")
workflow=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../apps/workflow")
"$workflow/../../cmake/install_debian_packages.sh" many
folder=$(mktemp -d)
started=()
finish() {
  for process in "${started[@]}"; do kill "$process" 2>/dev/null || true; done
  wait
  [[ -n "${KEEP:-}" ]] || rm -rf "$folder"
}
trap finish EXIT
chmod 755 "$folder"
cd "$folder"

mkdir -p meshes/sub
for seed in 1 2 3 4; do "$selvedge" generate skirt -o "meshes/skirt $seed.obj" --faces 4000 --seed $seed --quiet; done
"$selvedge" generate nested -o meshes/sub/nested.ply.gz --faces 4000 --quiet
echo hello >meshes/broken.obj
head -c 3000 "meshes/skirt 1.obj" >meshes/cut.obj
printf 'solid x\nendsolid\n' >meshes/empty.stl

run() { snakemake -s "$workflow/Snakefile" --config meshes=meshes out="$1" selvedge="$selvedge" ratios=0.5,0.2 -c 2 --rerun-incomplete "${@:2}"; }
expect() { [[ "$2" == "$3" ]] || { echo "$1: $3 in place of $2" >&2; exit 1; }; }
# Five meshes of two levels, and three that failed with exit code 3, below the head of the table.
expect_table() {
  expect "rows of $1" 14 "$(wc -l <"$1/table.csv")"
  expect "failures in $1" 3 "$(grep -c ',,3,' "$1/table.csv")"
}
jobs_left() { run "$1" -n 2>&1 | tee dry.log | awk '$1 == "simplify" && NF == 4 { n = $2 } END { print n + 0 }'; }

echo "--- Snakemake, interrupted as soon as one mesh is done, and resumed"
set -m # a process group of its own, which gets the signal as that of a terminal does
run out >first.log 2>&1 &
job=$!
set +m
until compgen -G 'out/*/outcome.json' >/dev/null; do sleep 0.1; done
kill -INT -- -"$job"
wait "$job" && { echo "it was not interrupted" >&2; exit 1; }
left=$(jobs_left out)
echo "$left of 8 meshes are left"
[[ $left -gt 0 && $left -lt 8 ]]
run out >second.log 2>&1
expect_table out
expect "jobs when all is done" 0 "$(jobs_left out)"
echo "# changed" >>meshes/cut.obj
expect "jobs when one mesh has changed" 1 "$(jobs_left out)"
rm out/broken.obj/outcome.json
expect "jobs when one outcome is removed, too" 2 "$(jobs_left out)"
cat out/table.csv

echo "--- GNU parallel"
in_parallel() {
  find meshes -type f -print0 | sort -z | parallel -0 -j 2 --joblog jobs.log --resume-failed \
    python3 "$workflow/simplify_one.py" --meshes meshes --ratios 0.5,0.2 --selvedge "$selvedge" --options "'--threads 1'" {} by_parallel 2>/dev/null
}
expect "exit code of parallel, the number of failures" 3 "$(in_parallel && echo 0 || echo $?)"
before=$(wc -l <jobs.log)
in_parallel || true # those that failed, and no others
expect "jobs run again" 3 $(($(wc -l <jobs.log) - before))
python3 "$workflow/table.py" by_parallel
expect_table by_parallel
for mesh in out/skirt*/*.obj out/sub/*/*.gz; do cmp "$mesh" "by_parallel/${mesh#out/}"; done

if [[ "${2:-}" == slurm ]]; then
  echo "--- Slurm"
  mkdir -p slurm/state slurm/spool
  dd if=/dev/urandom of=slurm/munge.key bs=128 count=1 status=none
  chmod 600 slurm/munge.key
  munged --foreground --force --key-file="$PWD/slurm/munge.key" --socket="$PWD/slurm/munge.socket" \
    --pid-file="$PWD/slurm/munge.pid" --log-file="$PWD/slurm/munge.log" --seed-file="$PWD/slurm/munge.seed" 2>/dev/null &
  started+=($!)
  cat >slurm/slurm.conf <<CONF
ClusterName=selvedge
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$PWD/slurm/munge.socket
CredType=cred/munge
StateSaveLocation=$PWD/slurm/state
SlurmdSpoolDir=$PWD/slurm/spool
SlurmctldPidFile=$PWD/slurm/slurmctld.pid
SlurmdPidFile=$PWD/slurm/slurmd.pid
SlurmctldPort=16817
SlurmdPort=16818
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SchedulerParameters=sched_interval=2
MinJobAge=300
$(slurmd -C | head -1) NodeAddr=127.0.0.1 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
CONF
  export SLURM_CONF=$PWD/slurm/slurm.conf
  slurmctld -D -f "$SLURM_CONF" >slurm/slurmctld.log 2>&1 &
  started+=($!)
  slurmd -D -f "$SLURM_CONF" >slurm/slurmd.log 2>&1 &
  started+=($!)
  for _ in $(seq 60); do [[ "$(sinfo -h -o %t 2>/dev/null)" == idle ]] && break; sleep 1; done
  sinfo
  # Without accounting, Snakemake learns from the files whether a job is done.
  run by_slurm -j 8 --latency-wait 30 --cluster 'sbatch --parsable -J selvedge -c {threads} -o slurm/%j.log' >slurm.log 2>&1 ||
    { tail -30 slurm.log slurm/*.log; exit 1; }
  expect_table by_slurm
  for mesh in out/skirt*/*.obj out/sub/*/*.gz; do cmp "$mesh" "by_slurm/${mesh#out/}"; done
  expect "jobs of Slurm" 8 "$(grep -c 'Submitted job' slurm.log)"
  scontrol -o show jobs | grep -o 'JobState=[A-Z]*' | sort | uniq -c
fi
echo "A folder of meshes works."
