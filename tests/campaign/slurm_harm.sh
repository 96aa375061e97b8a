#!/usr/bin/env bash
# slurm_harm.sh AMBRIG PRIVATE_SLURM: a campaign on the private Slurm in ./slurm, in the middle of which the disk
# is full and a task, the controller and a node are killed. Each step waits for rows; every loop has an end.
ambrig=$1 tool=$2
export SLURM_CONF=$PWD/slurm/slurm.conf

rows() { cat out/journal.txt 2> /dev/null | wc -l; }
wait_rows() {
  for _ in $(seq 1200); do [ "$(rows)" -ge "$1" ] && return; sleep 0.1; done
  echo "only $(rows) rows"
  kill -9 $main
  exit 8
}
tasks() { pgrep -f "campaign .*$PWD/c.toml -o $PWD/out/shards"; }
tasks_on() { for p in $(tasks); do grep -qz "^SLURMD_NODENAME=$1\$" /proc/$p/environ 2> /dev/null && echo $p; done; }
kill_recorded() { kill -9 "$(awk -v n="$1" '$1 == n { p = $2 } END { print p }' slurm/pids)"; }

campaign=("$ambrig" campaign c.toml -o out --engine slurm --tasks 8 --poll 0.5 --no-report)

# A limit on the size of a file stands for the full disk; tasks inherit it (Slurm's PropagateResourceLimits). Rows have about
# 350 bytes: the gathered journal is full after 45 of 480, those of the tasks after 45 of their 60.
(trap '' XFSZ; ulimit -f 16; exec timeout 300 "${campaign[@]}") > full.txt 2>&1
[ $? = 2 ] && grep -q "cannot write .*File too large" full.txt && echo "disk full at $(rows)"
full_task() { for f in out/shards/*/journal.txt; do [ "$(stat -c %s "$f")" -ge 16384 ] && return; done; false; }
for _ in $(seq 1200); do full_task && echo "disk full for a task" && break; sleep 0.1; done

"${campaign[@]}" > said.txt 2>&1 &
main=$!
# Between two tasks there is none, and a task that was seen may have ended before the signal comes.
for _ in $(seq 1500); do
  victim=$(tasks | head -1)
  [ -n "$victim" ] && kill -9 "$victim" 2> /dev/null && echo "task killed at $(rows)" && break
  sleep 0.02
done

wait_rows 120
for _ in $(seq 50); do [ -n "$(tasks_on n2)" ] && break; sleep 0.1; done  # between two tasks a node has none
kill_recorded slurmd-n2 && echo "node killed at $(rows)"
for p in $(tasks_on n2); do kill -9 "$(ps -o ppid= -p $p | tr -d ' ')" $p; done  # its task and the task's keeper die with it

wait_rows 180
kill_recorded slurmctld && echo "controller killed at $(rows)"
sleep 3
kill -0 $main || { echo "gave up"; exit 9; }
"$tool" controller slurm

# A controller that forgot its last seconds may take a node out of service, and it asks only every few minutes whether the tasks
# that it remembers still run: an administrator brings the node back and lets all nodes register again.
for k in $(seq 2400); do
  kill -0 $main 2> /dev/null || break
  sinfo -h -n n1 -t drain -o %N | grep -q n1 && scontrol update nodename=n1 state=resume
  [ $((k % 300)) = 0 ] && scontrol reconfigure
  sleep 0.1
done
kill -9 $main 2> /dev/null && { echo "did not end"; cat out/shards/jobs.txt; squeue; exit 7; }
wait $main
