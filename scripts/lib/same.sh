# shellcheck shell=bash
# Comparing the results of two sweeps.

# same_results DIR DIR: whether two output directories hold the same bytes; of the summary all but its times.
same_results() {
  local file
  for file in histories.csv.gz energy.csv; do cmp -s "$1/$file" "$2/$file" || return 1; done
  for file in histories envelopes; do diff -rq "$1/$file" "$2/$file" >/dev/null || return 1; done
  local columns='NR == 1 { for (i = 1; i <= NF; i++) if ($i == "wall_time_s") time = i } { $time = ""; print }'
  cmp -s <(awk -F, "$columns" "$1/summary.csv") <(awk -F, "$columns" "$2/summary.csv")
}
