#!/usr/bin/env bash
#
# Set up, build and run everything, on Debian 12 and 13:
#
#   ./setup.sh run    the thick ring, with the driver
#   ./setup.sh test   all tests, Debug and Release
#   ./setup.sh bench  speed against error: doc/performance.md anew; or heaps of blocks,
#                     or scenes with cracks
#   ./setup.sh fuzz N N random inputs of each kind, N / 100 of the slowest
#
# Safe to repeat. Environment variables, all optional:
#   NMM_JOBS=N                    compile and test with N jobs at a time
#   NMM_SKIP_PACKAGES=1           neither look for packages nor install any
#   NMM_PRESETS=release           what 'test' builds and tests ("debug release"); there is
#                                 'sanitize' as well
#   NMM_WARNINGS_AS_ERRORS=ON     treat warnings in this project's code as errors
#   NMM_UNITY_BUILD=OFF           compile each source by itself: faster after small
#                                 changes, twice as slow for all of it
#   OPENBLAS_NUM_THREADS=N        threads of the linear algebra library (1)

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

readonly packages=(
  g++ lld cmake ninja-build pkg-config git clang-format
  libdeal.ii-dev mpi-default-bin libmumps-dev libsuitesparse-dev libopenblas0-pthread
  libcgal-dev libeigen3-dev libboost-program-options-dev
  libcairo2-dev fonts-dejavu-core zlib1g-dev
  libgtest-dev gnuplot-nox valgrind)

# Open MPI as root, with more ranks than cores.
readonly open_mpi=(
  env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  OMPI_MCA_rmaps_base_oversubscribe=1
  PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
  OMPI_MCA_btl_vader_single_copy_mechanism=none)

export OPENBLAS_NUM_THREADS="${OPENBLAS_NUM_THREADS:-1}"


say()
{
  printf '\n== %s\n' "$*"
}


warn()
{
  printf 'setup.sh: warning: %s\n' "$*" >&2
}


die()
{
  printf 'setup.sh: %s\n' "$*" >&2
  exit 1
}


usage()
{
  cat <<'USAGE'
Usage: ./setup.sh run    set up, build, and run the thick ring
       ./setup.sh test   set up, build Debug and Release, and run every test
       ./setup.sh bench [quick|full|heaps|scenes]
                         set up, build, measure speed against error, and write
                         doc/performance.md anew: in minutes, or all of it in
                         half an hour; or measure heaps of blocks, for
                         tests/performance/heap.csv; or errors and seconds of
                         scenes with cracks, for tests/performance/scenes.csv
       ./setup.sh fuzz [N [SEED]]
                         set up, build, and run N (10000) random inputs of each kind;
                         those that fail are written below output/fuzz
USAGE
}


# Packages of the list above that are not installed.
missing_packages()
{
  local package
  for package in "${packages[@]}"; do
    [[ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" \
         == installed ]] || printf '%s ' "$package"
  done
}


install_packages()
{
  if [[ -n "${NMM_SKIP_PACKAGES:-}" ]]; then
    return
  fi
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    die "this is not a Debian system (no apt-get). Install deal.II 9.4 or later" \
        "with Trilinos (with MUMPS) and MPI, CGAL 5.5, Eigen 3.4, cairo," \
        "GoogleTest, CMake 3.21 and Ninja by other means, and run this again" \
        "with NMM_SKIP_PACKAGES=1."

  local missing
  read -ra missing <<<"$(missing_packages)"
  if [[ ${#missing[@]} -eq 0 ]]; then
    return
  fi

  say "Installing ${missing[*]}"
  local command="apt-get install ${missing[*]}"
  local as_root=()
  if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null ||
      die "the packages above are missing, and installing them takes root's" \
          "rights: there is no sudo here. Run this script once as root, or ask" \
          "for: $command"
    as_root=(sudo)
    if [[ ! -t 0 ]]; then
      as_root=(sudo -n)
    fi
    "${as_root[@]}" true ||
      die "sudo did not let you in, and the packages above are missing. Run this" \
          "script once as root, or ask for: $command"
  fi

  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get
             -q -o DPkg::Lock::Timeout=300)
  "${apt[@]}" -o APT::Update::Error-Mode=any update ||
    die "apt could not fetch the package lists (its message is above). Check the" \
        "network connection and /etc/apt, then run this again."
  local package
  for package in "${missing[@]}"; do
    apt-cache show "$package" >/dev/null 2>&1 ||
      die "this system has no package '$package'. Debian 12 (bookworm) and later" \
          "have it; see that /etc/apt names Debian's main archive."
  done
  "${apt[@]}" install -y --no-install-recommends "${missing[@]}" ||
    die "apt could not install the packages (its message is above). Check the" \
        "network connection and the space left on the disk, then run this again."
}


check_versions()
{
  if [[ -n "${NMM_SKIP_PACKAGES:-}" ]]; then
    return
  fi
  local version
  version="$(dpkg-query -W -f='${Version}' libdeal.ii-dev)"
  dpkg --compare-versions "$version" ge 9.4 ||
    die "this system's deal.II is $version, and 9.4 or later is needed: use" \
        "Debian 12 or later, or install deal.II yourself, set DEAL_II_DIR and" \
        "run this again with NMM_SKIP_PACKAGES=1."

  # The direct solver is 2.5 times slower with the reference BLAS.
  local name library
  for name in libblas.so.3 liblapack.so.3; do
    library="$(PATH="$PATH:/sbin:/usr/sbin" ldconfig -p |
                 awk -v n="$name" '$1 == n && !l {l = $NF} END {print l}')"
    library="$(readlink -f "${library:-$name}" || true)"
    [[ "$library" == *openblas* ]] ||
      warn "$name is '$library', not OpenBLAS: direct solves will be slow." \
           "As root, run: update-alternatives --auto $name-$(gcc -print-multiarch)"
  done
}


# Compiling one source file takes up to 2 GB.
n_jobs()
{
  if [[ -n "${NMM_JOBS:-}" ]]; then
    echo "$NMM_JOBS"
    return
  fi
  local cores by_memory
  cores="$(nproc)"
  by_memory="$(awk '/^MemAvailable/ {print int($2 / 2000000)}' /proc/meminfo)"
  [[ -n "$by_memory" && "$by_memory" -lt "$cores" ]] && cores="$by_memory"
  echo $((cores > 1 ? cores : 1))
}


# configure_and_build <preset> [<target>...]
configure_and_build()
{
  local preset="$1"
  shift

  # A tree that was moved or copied brings a cache that names the old place.
  local cache="build/$preset/CMakeCache.txt"
  if [[ -f "$cache" ]] &&
     ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$(pwd -P)" "$cache"; then
    warn "build/$preset belongs to another source tree; starting it afresh."
    rm -rf "build/$preset"
  fi

  local log="build/configure-$preset.log"
  mkdir -p build
  say "Configuring build/$preset"
  if ! cmake --preset "$preset" \
         -DNMM_WARNINGS_AS_ERRORS="${NMM_WARNINGS_AS_ERRORS:-OFF}" \
         -DCMAKE_UNITY_BUILD="${NMM_UNITY_BUILD:-ON}" \
         -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 \
         >"$log" 2>&1; then
    cat "$log" >&2
    die "CMake could not configure the project (its message is above). If it" \
        "speaks of a stale cache, remove build/$preset and run this again."
  fi

  say "Building build/$preset"
  local target_arguments=()
  if [[ $# -gt 0 ]]; then
    target_arguments=(--target "$@")
  fi
  cmake --build --preset "$preset" --parallel "$(n_jobs)" \
    "${target_arguments[@]}" ||
    die "the $preset build failed (the compiler's message is above). If it says" \
        "'Killed', memory ran out: try again with NMM_JOBS=1."
}


command_run()
{
  local scene=applications/nmm/scenes/ring.prm
  local output=output/ring

  configure_and_build release program_nmm

  say "Running $scene"
  local status=0
  build/release/bin/nmm --output "$output" "$scene" || status=$?
  [[ $status -eq 0 ]] ||
    die "the driver ended with exit code $status (its message is above)."
  local file
  for file in summary.csv picture.png; do
    [[ -s "$output/$file" ]] ||
      die "the driver ended well but did not write $output/$file."
  done

  say "Done. Look at:"
  printf '   picture  %s\n   table    %s\n' \
    "$PWD/$output/picture.png" "$PWD/$output/summary.csv"
}


command_test()
{
  local preset failed=()
  local presets
  read -ra presets <<<"${NMM_PRESETS:-debug release}"
  for preset in "${presets[@]}"; do
    [[ "$preset" =~ ^(debug|release|sanitize)$ ]] ||
      die "NMM_PRESETS names '$preset'; there are debug, release and sanitize."
  done
  for preset in "${presets[@]}"; do
    configure_and_build "$preset"
    say "Testing build/$preset"
    ctest --preset "$preset" --no-tests=error --parallel "$(n_jobs)" ||
      failed+=("$preset")
  done

  [[ ${#failed[@]} -eq 0 ]] ||
    die "tests failed in: ${failed[*]} (see above; to repeat them:" \
        "ctest --preset ${failed[0]} --rerun-failed)."
  say "All tests passed (${presets[*]})."
}


command_fuzz()
{
  local generator failed=()
  configure_and_build release program_nmm-fuzz
  local n
  for generator in geometry scene growth contact-growth growth-in-motion \
      blocks networks; do
    # a solution with contact, and a motion, take seconds, a network half a minute
    n=$1
    [[ $generator != *-* && $generator != blocks ]] || n=$(($1 / 100 + 1))
    [[ $generator != networks ]] || n=$(($1 / 500 + 1))
    say "Random inputs: $generator"
    build/release/bin/nmm-fuzz "$generator" "$n" "$2" || failed+=("$generator")
  done
  [[ ${#failed[@]} -eq 0 ]] ||
    die "some failed (see above): their scenes are below output/fuzz."
}


command_bench()
{
  local size="$1"
  local folder=tests/performance
  local table="$folder/performance.csv"
  local program=build/release/bin/nmm-bench

  configure_and_build release program_nmm-bench program_nmm-kernels

  say "Measuring ($size)"
  "$program" measure "$size" "$table" ||
    die "the measurements ended early (the message is above); $table has the" \
        "rows before."

  local on_two_ranks=(mpirun -np 2)
  if mpirun --version 2>&1 | grep -q 'Open MPI'; then
    on_two_ranks=("${open_mpi[@]}" mpirun --oversubscribe -np 2)
  fi
  say "Measuring on two ranks"
  "${on_two_ranks[@]}" "$program" measure "$size" "$table" ||
    die "the measurements on two ranks failed (the message is above)."

  say "Counting"
  local dumps
  dumps="$(mktemp -d)"
  if [[ "$size" == full && -x build/release/bin/nmm-kernels ]] &&
     command -v valgrind >/dev/null; then
    valgrind --tool=callgrind --instr-atstart=no \
             --callgrind-out-file="$dumps/callgrind" build/release/bin/nmm-kernels ||
      die "callgrind could not run nmm-kernels (the message is above)."
  fi
  "$program" counts "$folder/counts.csv" "$dumps" ||
    die "the counts failed (the message is above)."
  rm -r "$dumps"

  say "Writing the report"
  "$program" report "$table" doc ||
    die "the report could not be written (the message is above)."

  say "Done. Look at:"
  printf '   report  %s\n   table   %s\n' "$PWD/doc/performance.md" "$PWD/$table"
}


machine()
{
  echo "$(awk -F': ' '/^model name/ {print $2; exit}' /proc/cpuinfo), $(nproc) cores"
}


# Scenes with cracks: errors beside seconds, and the table of doc/accuracy.md.
command_bench_scenes()
{
  local table=tests/performance/scenes.csv page=doc/accuracy.md

  configure_and_build release program_nmm nmm-scene-errors

  say "Running scenes with cracks (3 minutes)"
  OPENBLAS_NUM_THREADS=1 "${open_mpi[@]}" \
    build/release/bin/nmm-scene-errors "$table" "$page" \
    "# $(machine), one for each rank; $(date +%F); made by ./setup.sh bench scenes" ||
    die "a scene failed (the message is above); $table is as it was."

  say "Done. Look at:"
  printf '   page   %s\n   table  %s\n' "$PWD/$page" "$PWD/$table"
}


# Heaps of blocks. Those that are compared are taken forward by turns in one process: a
# shared machine is up to 1.5 times as fast at one time as at another, and both meet the
# same times then. Memory is that of a process with one heap.
command_bench_heaps()
{
  local table=tests/performance/heap.csv
  local program=build/release/bin/nmm-heap

  configure_and_build release program_nmm-heap

  say "Measuring heaps (15 minutes)"
  local lines round
  lines="$(mktemp -d)/heap.csv"
  heap()
  {
    say "nmm-heap $*"
    "$program" "$1" "$2" "$3" "$lines" "${@:4}" >/dev/null ||
      die "nmm-heap failed (its message is above); $table is as it was."
  }
  # by turns, for times; alone, for memory
  for round in 1 2 3; do
    heap 200,2000 0 1 0 0 8
  done
  heap 200,2000 0 0.3
  heap 200,2000 0 1
  heap 200 0 1 0 0 8
  heap 2000 0 1 0 0 8
  heap 2000 0 1
  heap 20 0 0.3
  heap 20 0 1
  heap 20 4 0.3
  heap 200 4 0.3
  heap 20 0 6 0 0.001
  heap 20 0 6 0.05 0.001
  {
    echo "# $(machine), one used, processor time; $(date +%F);" \
         "made by ./setup.sh bench heaps"
    cat "$lines"
  } >"$table"
  rm -r "$(dirname "$lines")"

  say "Done. From 200 to 2,000 blocks, us per block and step, and ratio:"
  awk -F, '
    $1 == "blocks" {for (i = 1; i <= NF; ++i) c[$i] = i}
    # both halves have the same number of steps
    function show(phase, first, now) {
      print ($c["rows"] == 8 ? "equally deep," : "same shape,"), phase,
            "until", $c["end_s"], "s:", first, now, now / first
    }
    $c["heaps"] != 2 {next}
    $1 == 200 {first = $c["us_per_block_and_step"]}
    $1 == 2000 {
      now = $c["us_per_block_and_step"]
      show($c["phase"], first, now)
      if ($c["phase"] == "falls") {first_half = first; half = now}
      else show("both", (first_half + first) / 2, (half + now) / 2)
    }' "$table"
}


main()
{
  case "${1:-}" in
    run | test)
      if [[ $# -gt 1 ]]; then
        usage >&2
        die "'$1' takes no arguments; '$2' is one too many."
      fi
      install_packages
      check_versions
      "command_$1"
      ;;
    bench)
      local size="${2:-quick}"
      if [[ $# -gt 2 || ! "$size" =~ ^(quick|full|heaps|scenes)$ ]]; then
        usage >&2
        die "'bench' takes one argument at most, 'quick', 'full', 'heaps' or 'scenes'."
      fi
      install_packages
      check_versions
      if [[ "$size" =~ ^(heaps|scenes)$ ]]; then
        "command_bench_$size"
      else
        command_bench "$size"
      fi
      ;;
    fuzz)
      if [[ $# -gt 3 || ! "${2:-1}${3:-1}" =~ ^[0-9]+$ ]]; then
        usage >&2
        die "'fuzz' takes two numbers at most: of cases, and the first seed."
      fi
      install_packages
      check_versions
      command_fuzz "${2:-10000}" "${3:-1}"
      ;;
    help | -h | --help)
      usage
      ;;
    '')
      usage >&2
      die "say what to do: 'run', 'test', 'bench' or 'fuzz'."
      ;;
    *)
      usage >&2
      die "there is no command '$1'; there are 'run', 'test', 'bench' and 'fuzz'."
      ;;
  esac
}

main "$@"
