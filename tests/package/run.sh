#!/usr/bin/env bash
# run.sh HOW BUILD SOURCE FOLDER: takes regoplan into a project of somebody else's and runs what
# comes of it. HOW: find_package (installs BUILD first), add_subdirectory, program (the installed
# program, from another folder, its prefix read-only), or deb (the Debian package, installed into an
# empty root, its demo run by another user, removed again).
set -euo pipefail
how=$1 build=$2 source=$3 folder=$4
rm -rf "$folder"
mkdir -p "$folder"

install_to_prefix() {
  cmake --install "$build" --prefix "$folder/prefix" >"$folder/install.log"
}

consume() {  # command line of the program to run, then options for CMake
  local program=$1
  shift
  cmake -S "$source/tests/package/consumer" -B "$folder/build" -G Ninja \
    -DCMAKE_BUILD_TYPE=Release -DREGOPLAN_SOURCE="$source" "$@" >"$folder/configure.log"
  cmake --build "$folder/build" >"$folder/build.log" || { cat "$folder/build.log"; exit 1; }
  (cd "$folder/build" && eval "./$program")
}

another_user() {  # runs a command as nobody where we are root, else as we are
  if ((EUID == 0)); then
    runuser -u nobody -- "$@"
  else
    "$@"
  fi
}

into_root() {  # dpkg on a root of its own, whose libraries are those of this machine
  dpkg --root="$root" --force-not-root --force-bad-path --force-depends \
    --force-script-chrootless --log="$folder/dpkg.log" "$@" >>"$folder/dpkg.out" 2>&1 ||
    { cat "$folder/dpkg.out"; exit 1; }
}

case $how in
find_package)
  install_to_prefix
  consume wheel -DHOW=find_package -DCOMPONENTS=terramech -DCMAKE_PREFIX_PATH="$folder/prefix"
  if ldd "$folder/build/wheel" | grep -E 'gdal|ompl|ceres'; then
    echo 'terramech alone needs none of these' >&2
    exit 1
  fi
  rm -r "$folder/build"
  consume ompl_program -DHOW=find_package "-DCOMPONENTS=terramech;planner;diagnosis" \
    -DCMAKE_PREFIX_PATH="$folder/prefix"
  rm -r "$folder/build"
  consume "own_benchmark '$source/examples/own_planner_suite.yaml' --out result" -DHOW=find_package \
    -DCOMPONENTS=app -DCMAKE_PREFIX_PATH="$folder/prefix"
  ;;
add_subdirectory)
  # Of the processors, so that what else runs on the machine does not count.
  TIMEFORMAT='%U %S'
  { time consume wheel -DHOW=add_subdirectory >"$folder/output" 2>&1; } 2>"$folder/time" ||
    { cat "$folder/output"; exit 1; }
  on_two_cores_s=$(awk '{printf "%.0f", ($1 + $2) / 2}' "$folder/time")
  packages=$(ninja -C "$folder/build" -t deps | sed -n 's|^ *\(/usr/.*\)|\1|p' | sort -u |
    xargs dpkg -S 2>/dev/null | sed 's/:.*//' | sort -u | tr '\n' ' ' || true)
  echo "terramech alone: builds in $on_two_cores_s s on two cores; what it includes is of the" \
    "packages: $packages"
  if ((on_two_cores_s > 120)); then
    echo 'terramech alone should build in two minutes on two cores' >&2
    exit 1
  fi
  if grep -E 'gdal|ompl|ceres|yaml|nlohmann|gtest|benchmark' <<<"$packages"; then
    echo 'terramech alone needs none of these' >&2
    exit 1
  fi
  ;;
program)
  install_to_prefix
  chmod -R a-w "$folder/prefix"
  trap 'chmod -R u+w "$folder/prefix"' EXIT
  mkdir "$folder/elsewhere"
  cd "$folder/elsewhere"
  "$folder/prefix/bin/regoplan" map make --out map --seed 3 --quiet
  "$folder/prefix/bin/regoplan" map info map/scenario.yaml
  # What it reads of its own is installed too: it looks nowhere else.
  "$folder/prefix/bin/regoplan" scenario >scenario.yaml
  "$folder/prefix/bin/regoplan" soil firm_regolith >soils.yaml
  "$folder/prefix/bin/regoplan" plan scenario.yaml --planner Lattice --iterations 600 --candidates 1 --quiet --out plan
  for sensors in A B; do
    "$folder/prefix/bin/regoplan" drive scenario.yaml plan/candidate-1.csv --sensors $sensors --quiet --out drive-$sensors
    test -s drive-$sensors/drive.csv
  done
  ;;
deb)
  (cd "$build" && cpack -G DEB -B "$folder" >"$folder/cpack.log") || { cat "$folder/cpack.log"; exit 1; }
  package=$(echo "$folder"/regoplan_*.deb)
  work=$(mktemp -d)
  chmod 777 "$work"  # for the other user, who may not get to where we build
  root="$work/root"
  trap 'chmod -R u+w "$work"; rm -r "$work"' EXIT
  mkdir -p "$root/var/lib/dpkg/"{info,updates}
  touch "$root/var/lib/dpkg/"{status,available}
  into_root -i "$package"
  chmod -R a-w "$root/usr"
  (cd "$work" && another_user "$root/usr/bin/regoplan" demo --no-drive --planner Lattice --iterations 600 --candidates 1 --quiet --out result)
  test -s "$work/result/report.html"
  chmod -R u+w "$root/usr"
  into_root --purge regoplan
  left=$(find "$root/usr" -type f 2>/dev/null || true)
  if [[ -n "$left" ]]; then
    echo "left behind: $left" >&2
    exit 1
  fi
  echo "$(basename "$package"): $(stat -c %s "$package") bytes; needs" \
    "$(dpkg-deb -f "$package" Depends)"
  ;;
*)
  echo "$how is not known (allowed: find_package, add_subdirectory, program, deb)" >&2
  exit 1
  ;;
esac
