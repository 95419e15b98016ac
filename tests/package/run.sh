#!/usr/bin/env bash
# run.sh HOW BUILD SOURCE FOLDER: takes regoplan into a project of somebody else's and runs what
# comes of it. HOW: find_package (installs BUILD first), add_subdirectory, or program (the installed
# program, from another folder, its prefix read-only).
set -euo pipefail
how=$1 build=$2 source=$3 folder=$4
rm -rf "$folder"
mkdir -p "$folder"

install_to_prefix() {
  cmake --install "$build" --prefix "$folder/prefix" >"$folder/install.log"
}

consume() {  # name of the program to run, then options for CMake
  local program=$1
  shift
  cmake -S "$source/tests/package/consumer" -B "$folder/build" -G Ninja \
    -DCMAKE_BUILD_TYPE=Release -DREGOPLAN_SOURCE="$source" "$@" >"$folder/configure.log"
  cmake --build "$folder/build" >"$folder/build.log" || { cat "$folder/build.log"; exit 1; }
  "$folder/build/$program"
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
  ;;
add_subdirectory)
  started=$SECONDS
  consume wheel -DHOW=add_subdirectory
  echo "terramech alone: built in $((SECONDS - started)) s; packages found:" \
    "$(sed -n 's/^\([A-Za-z0-9]*\)_DIR:PATH=.*/\1/p' "$folder/build/CMakeCache.txt" | tr '\n' ' ')"
  ;;
program)
  install_to_prefix
  chmod -R a-w "$folder/prefix"
  trap 'chmod -R u+w "$folder/prefix"' EXIT
  mkdir "$folder/elsewhere"
  cd "$folder/elsewhere"
  "$folder/prefix/bin/regoplan" map make --out map --seed 3 --quiet
  "$folder/prefix/bin/regoplan" map info map/scenario.yaml
  ;;
*)
  echo "$how is not known (allowed: find_package, add_subdirectory, program)" >&2
  exit 1
  ;;
esac
