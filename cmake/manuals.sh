#!/usr/bin/env bash
# manuals.sh PROGRAM VERSION FOLDER: manual pages of the program and each of its commands, made from
# their --help by help2man.
set -euo pipefail
program=$1 version=$2 folder=$3
rm -rf "$folder"
mkdir -p "$folder"

page() {  # words of the command, none for the program itself
  local name="regoplan${1:+ $*}"
  local summary
  summary=$("$program" "$@" --help | head -1)
  help2man --no-info --section=1 --version-string="$version" --name="${summary%.}" \
    --output="$folder/${name// /-}.1" "$program${1:+ $*}"
}

commands_of() {  # those that the help of a command lists
  "$program" "$@" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p'
}

page
for command in $(commands_of); do
  page "$command"
  for below in $(commands_of "$command"); do
    page "$command" "$below"
  done
done
