#!/usr/bin/env bash
# man_pages.sh VERSION DATE FOLDER PROGRAM...
# Makes a man page of each program and of each of its commands from what `--help` prints, compressed as Debian has them:
# oriel.1.gz, oriel-label.1.gz, oriel-rules.1.gz, oriel-rules-check.1.gz and so on.
set -euo pipefail
version=$1 folder=$3
SOURCE_DATE_EPOCH=$(date -d "$2" +%s)
export SOURCE_DATE_EPOCH
shift 3

command -v help2man >/dev/null || { echo "man pages are made by help2man, which is not installed" >&2; exit 1; }
mkdir -p "$folder"

# The names below "Subcommands:" in a help text.
commands_in() { awk '/^Subcommands:/ {inside = 1; next} /^[^ ]/ {inside = 0} inside && /^  [a-z]/ {print $1}'; }

# The help text as help2man reads it best: both names of an option, and a paragraph for each example.
for_help2man() {
  sed -E 's/^  (-[a-zA-Z]),--/  \1, --/; s/^Positionals:/Arguments:/; s/^Subcommands:/Commands:/; s/^Example: *(.*)/\nExamples:\n  \1/' |
    awk '/^Examples:/ {examples = 1} {print} examples && /^  / {print ""}'
}

# make_page PROGRAM COMMAND...: its page, and those of the commands below it.
make_page() {
  local words=("$(basename "$1")" "${@:2}")
  local name sentence help page see
  name=$(IFS=-; echo "${words[*]}")
  help=$("$@" --help)
  sentence=$(sed -n "/[^ ]/{s/^${words[0]} //;s/[.]\$//;p;q}" <<<"$help")
  # A program that prints what the command prints is what help2man asks.
  page=$folder/$name.1
  see=$scratch/see
  { echo "[name]"; echo "$name \\- ${sentence,}"; } >"$see"
  if [ ${#words[@]} -gt 1 ]; then
    { echo; echo "[see also]"; echo ".BR ${words[0]} (1)"; } >>"$see"
  else
    { echo; echo "[see also]"; commands_in <<<"$help" | sed "s/.*/.BR $name-& (1),/" | sed '$s/,$//'; } >>"$see"
  fi
  for_help2man <<<"$help" >"$scratch/help"
  printf '#!/bin/sh\ncat %q\n' "$scratch/help" >"$scratch/$name"
  chmod +x "$scratch/$name"
  help2man --no-info --no-discard-stderr --section=1 --source="oriel $version" \
    --manual="oriel" --version-string="$version" --include="$see" --output="$page" "$scratch/$name"
  gzip -9nf "$page"
  chmod 644 "$page.gz"
  local command
  for command in $(commands_in <<<"$help"); do make_page "$@" "$command"; done
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for program in "$@"; do make_page "$program"; done
