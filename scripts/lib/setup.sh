# shellcheck shell=bash
# What the scripts share: finding and installing what a build needs, building, and launching.
# Everything said goes to stderr, one line each, so that a program's own output stays clean.
#
# SEAWALL_BINARY=FILE names a finished program that is to run instead of one built here. It runs on
# threads. Examples and benchmarks are built all the same. SEAWALL_MPI_BINARY=FILE names one that was built
# with MPI.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
target=${CARGO_TARGET_DIR:-$root/target}
[[ $target = /* ]] || target=$PWD/$target # scripts go elsewhere
setup_log=$target/setup.log

say() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }

fail() {
  say "$*"
  exit 70
}

# usage WORDS...: what is wrong with the words that a script was given.
usage() {
  say "$*; see scripts/${0##*/} --help"
  exit 2
}

# The comment at the top of the script.
tell_help() { sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "$0"; }

# Every script answers --help before it does anything else.
for word in "$@"; do
  case $word in
    -h | --help)
      tell_help
      exit 0
      ;;
  esac
done

need_cargo() {
  command -v cargo >/dev/null || PATH=$HOME/.cargo/bin:$PATH
  command -v cargo >/dev/null || fail "cargo is missing: install Rust first (rustup.rs)"
  mkdir -p "$target"
}

as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
    sudo -n "$@"
  else
    return 1
  fi
}

# install_packages PACKAGE...: through apt, without questions; fails where it has no right to.
install_packages() {
  if ! command -v apt-get >/dev/null || ! as_root true; then
    say "cannot install $*: no apt-get, or neither root nor sudo without a password"
    return 1
  fi
  say "installing $* (apt-get)"
  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=120)
  as_root "${apt[@]}" update >"$setup_log" 2>&1 || say "apt-get update failed, trying to install anyway"
  as_root "${apt[@]}" install -y --no-install-recommends "$@" >>"$setup_log" 2>&1 </dev/null || {
    say "installing failed, see $setup_log"
    return 1
  }
}

# The binding generator needs libclang itself and the compiler headers that come with it.
have_libclang() {
  [ -n "${LIBCLANG_PATH:-}" ] && return 0
  command -v clang >/dev/null && return 0
  { compgen -G '/usr/lib/llvm-*/lib/libclang.so*' || compgen -G '/usr/lib/*/libclang-[0-9]*.so*'; } >/dev/null &&
    { compgen -G '/usr/lib/llvm-*/lib/clang/*/include/stddef.h' || compgen -G '/usr/lib/clang/*/include/stddef.h'; } >/dev/null
}

need_compiler() {
  command -v cc >/dev/null || install_packages gcc libc6-dev || true
  command -v cc >/dev/null ||
    fail "a C compiler is missing: Rust needs one to link (Debian: apt-get install gcc libc6-dev)"
}

# need_mpi: installs what the mpi feature needs and this machine lacks, and tries the launcher.
need_mpi() {
  local missing=()
  command -v mpirun >/dev/null || missing+=(openmpi-bin)
  command -v mpicc >/dev/null || missing+=(libopenmpi-dev)
  have_libclang || missing+=(libclang-dev)
  if [ ${#missing[@]} != 0 ]; then
    install_packages "${missing[@]}" || return 1
  fi
  mpi_environment
  launcher "$(cores)"
  timeout 60 "${launch[@]}" true >"$setup_log" 2>&1 </dev/null || {
    say "mpirun cannot run here, see $setup_log"
    return 1
  }
}

# need_chromium: what the tests of the page's figures look with; they skip themselves without it.
need_chromium() {
  local name
  for name in "${CHROMIUM:-chromium}" chromium-browser google-chrome chrome-headless-shell; do
    command -v "$name" >/dev/null && chromium=$name && return 0
  done
  install_packages chromium && chromium=chromium
}

# cores: what this process may use, no more than a container's quota allows.
cores() {
  local count quota period limit
  count=$(nproc)
  if read -r quota period 2>/dev/null </sys/fs/cgroup/cpu.max && [ "$quota" != max ]; then
    limit=$(((quota + period - 1) / period))
  elif read -r quota 2>/dev/null </sys/fs/cgroup/cpu/cpu.cfs_quota_us && [ "$quota" -gt 0 ]; then
    read -r period </sys/fs/cgroup/cpu/cpu.cfs_period_us
    limit=$(((quota + period - 1) / period))
  else
    limit=$count
  fi
  [ "$limit" -lt "$count" ] && count=$limit
  echo $((count > 0 ? count : 1))
}

# What Open MPI needs as root, and in containers that forbid reading another process's memory.
mpi_environment() {
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  export OMPI_MCA_btl_vader_single_copy_mechanism=none
  # A machine that was cut off is noticed after some ten seconds; Open MPI's own times make it eight minutes.
  export OMPI_MCA_oob_tcp_keepalive_time=${OMPI_MCA_oob_tcp_keepalive_time-5}
  export OMPI_MCA_oob_tcp_keepalive_intvl=${OMPI_MCA_oob_tcp_keepalive_intvl-2}
  export OMPI_MCA_oob_tcp_keepalive_probes=${OMPI_MCA_oob_tcp_keepalive_probes-3}
  # One machine: looking for fast networks would take a quarter of a second.
  export OMPI_MCA_pml=${OMPI_MCA_pml-ob1}
  # Without ssh, Open MPI refuses even local runs unless told to stay local.
  command -v ssh >/dev/null || export OMPI_MCA_plm=isolated
}

# end_of JOB: waits for it, whatever signals come, and sets `ended` to its exit code.
end_of() {
  local again=0
  while :; do
    ended=0
    wait "$1" || ended=$?
    kill -0 "$1" 2>/dev/null || break # else a signal has cut `wait` short
  done
  # It may also have cut short the wait in which the job ended.
  wait "$1" 2>/dev/null || again=$?
  [ "$again" = 127 ] || ended=$again
}

# attended COMMAND...: runs it and gives its exit code. A signal that would end the script goes to the command and
# all that it has started, and then ends the script as it ended the command. No $(...) around it, see scripts/sweep.
attended() {
  local job='' stopped=no
  pass_on() {
    stopped=yes
    [ -z "$job" ] || kill -TERM -- "-$job" 2>/dev/null || kill -TERM "$job" 2>/dev/null || true
  }
  trap pass_on INT TERM HUP
  # With job control it has a process group of its own, and hears SIGINT, which a background job else ignores.
  set -m
  "$@" </dev/null &
  job=$!
  set +m
  [ "$stopped" = no ] || pass_on # the signal came before there was a job to pass it on to
  end_of "$job"
  trap - INT TERM HUP
  [ "$stopped" = no ] || exit "$ended"
  return "$ended"
}

# first_look COMMAND...: tries a sweep with --dry-run before anything is removed or written. Words that cannot be used
# end the script here. So does --dry-run where it is among the words: that was all that was asked for.
first_look() {
  local word words=() dry=no
  for word in "$@"; do
    if [ "$word" = --dry-run ]; then dry=yes; else words+=("$word"); fi
  done
  if [ "$dry" = yes ]; then
    attended "${words[@]}" --dry-run
    exit
  fi
  attended "${words[@]}" --dry-run >/dev/null
}

# stop_unless_failed CODE: after a sweep. A case that failed (1) is told in its tables; half a study is none.
stop_unless_failed() { [ "$1" -le 1 ] || exit "$1"; }

# launcher RANKS: sets the array `launch`. Slots are stated, because the default counts physical
# cores, and ranks are not bound, because a container's cores may not be the machine's.
launcher() {
  launch=(mpirun -q -n "$1" --host "localhost:$1" --bind-to none)
}

# given_binary VARIABLE: takes the program that a variable names, if it names one.
given_binary() {
  local given=${!1:-}
  [ -n "$given" ] || return 1
  [ -f "$given" ] && [ -x "$given" ] || fail "$1=$given: must be a program"
  binary=$(realpath "$given")
}

build_threads() {
  given_binary SEAWALL_BINARY && return
  say "building (threads)"
  (cd "$root" && CARGO_TARGET_DIR=$target cargo build --release --quiet) || fail "the build failed"
  binary=$target/release/seawall
}

# build_mpi: builds with MPI, in a target directory of its own so that neither build undoes the
# other's, and tries it; fails with one line where MPI does not work here.
build_mpi() {
  [ -z "${SEAWALL_BINARY:-}" ] || return 1
  need_mpi || return 1
  given_binary SEAWALL_MPI_BINARY && return
  say "building (MPI)"
  (cd "$root" && CARGO_TARGET_DIR=$target/mpi cargo build --release --features mpi) >"$setup_log" 2>&1 || {
    say "building with MPI failed, see $setup_log"
    return 1
  }
  binary=$target/mpi/release/seawall
  local trial=("$binary" sweep "$root/sweeps/smoke.toml" --dry-run --executor mpi --out "$target/trial")
  timeout 60 "${launch[@]}" "${trial[@]}" >"$setup_log" 2>&1 </dev/null || {
    say "a trial run under mpirun failed, see $setup_log"
    return 1
  }
}
