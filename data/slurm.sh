#!/bin/bash
# Written by `seawall slurm`. Give it to sbatch. It runs the study, ends in good order before the time limit,
# and puts itself back into the queue until every case is done.
#SBATCH --job-name={NAME}
#SBATCH --nodes={NODES}
{CORES}
#SBATCH --time={TIME}
#SBATCH --signal=B:USR1@{GRACE}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output={NAME}-%j.log
set -u

seawall={SEAWALL}
study={FILE}
out={OUT}
# What the study names by a relative path, such as a recorded stroke, is sought from here.
cd {FOLDER} || exit 70

# Slurm sends USR1 to this script {GRACE} s before the limit. Passed on, it makes seawall stop: what has
# finished is on the disk, and long cases leave checkpoints.
job= stopped=no
stop() {
  stopped=yes
  [ -z "$job" ] || kill -USR1 "$job" 2>/dev/null
}
trap stop USR1 TERM

# A machine that is cut off is noticed after some eleven seconds: the ranks' launcher asks after 5 s of silence,
# every 2 s, three times. By themselves Open MPI 4 and 5 wait for minutes. Other launchers pay no heed.
export OMPI_MCA_oob_tcp_keepalive_time="${OMPI_MCA_oob_tcp_keepalive_time-5}"
export OMPI_MCA_oob_tcp_keepalive_intvl="${OMPI_MCA_oob_tcp_keepalive_intvl-2}"
export OMPI_MCA_oob_tcp_keepalive_probes="${OMPI_MCA_oob_tcp_keepalive_probes-3}"
export PRTE_MCA_oob_tcp_keepalive_time="${PRTE_MCA_oob_tcp_keepalive_time-5}"
export PRTE_MCA_oob_tcp_keepalive_intvl="${PRTE_MCA_oob_tcp_keepalive_intvl-2}"
export PRTE_MCA_oob_tcp_keepalive_probes="${PRTE_MCA_oob_tcp_keepalive_probes-3}"

# Changes whenever a case, a checkpoint of one or a new film is done.
progress() {
  { cd "$out" && cat journal.jsonl && { ls -l --full-time checkpoints; ls films; }; } 2>/dev/null | cksum
}

# Ends here, with the reason.
give_up() {
  echo "$1: not put back into the queue" >&2
  exit 3
}

# A start that was told to stop before it got any further leaves its job's number here. The next such start is the last.
idle=$out/slurm.idle

before=$(progress)
# What stands before the launcher keeps the threads of a rank from sharing a single core.
{LAUNCH} "$seawall" sweep "$study" --out "$out"{MORE} &
job=$!
# The signal came before there was a job to pass it on to. One that is only just being started would lose it.
[ "$stopped" = no ] || { sleep 1; stop; }
while :; do
  code=0
  wait "$job" || code=$?
  kill -0 "$job" 2>/dev/null || break # else a signal has cut `wait` short
done
[ "$code" = 2 ] && exit 2 # bad input: nothing to go on with

# The journal knows better than any launcher whether something is left.
"$seawall" --quiet status --exit-code "$out"
left=$?
case $left in
  0 | 1)
    rm -f "$idle"
    exit "$left"
    ;;
  3) ;;
  *) exit 70 ;; # there is no journal: the ranks were not even started
esac
# `scancel` sends TERM, too. Such a job does not run any more, nor does one that its time limit has ended.
case $(squeue -h -j "$SLURM_JOB_ID" -o '%T %r') in
  RUNNING* | *TimeLimit) ;;
  *) give_up "the job was cancelled, or the queue does not answer" ;;
esac
if [ "$(progress)" != "$before" ]; then
  rm -f "$idle"
elif [ "$stopped" = no ]; then
  give_up "the job died and got no further (code $code)"
elif [ "$(cat "$idle" 2>/dev/null)" = "$SLURM_JOB_ID" ]; then
  rm -f "$idle"
  give_up "two starts in a row were told to stop and got no further, so the time limit is too short"
else
  echo "$SLURM_JOB_ID" >"$idle"
fi
echo "cases are left: back into the queue" >&2
scontrol requeue "$SLURM_JOB_ID" || exit 3
# Slurm ends this script now; without the right to requeue it stays here no longer than this.
sleep 60
exit 3
