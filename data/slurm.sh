#!/bin/bash
# Written by `seawall slurm`. Give it to sbatch. It runs the study, ends in good order before the time limit,
# and puts itself back into the queue until every case is done.
#SBATCH --job-name={NAME}
#SBATCH --nodes={NODES}
#SBATCH --ntasks-per-node={RANKS}
#SBATCH --cpus-per-task={THREADS}
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

before=$(progress)
# Since Slurm 22.05 srun does not ask for the job's cores per task by itself: threads might share a single one.
{LAUNCH} "$seawall" sweep "$study" --out "$out"{MORE} &
job=$!
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
  0 | 1) exit "$left" ;;
  3) ;;
  *) exit 70 ;; # there is no journal: the ranks were not even started
esac
if [ "$stopped" = no ] && [ "$(progress)" = "$before" ]; then
  echo "the job died and got no further (code $code): not put back into the queue" >&2
  exit 3
fi
echo "cases are left: back into the queue" >&2
scontrol requeue "$SLURM_JOB_ID" || exit 3
# Slurm ends this script now; without the right to requeue it stays here no longer than this.
sleep 60
exit 3
