#!/usr/bin/env bash
# Shows the [done/all] of the lines that it reads, as ninja prints them, and nothing else: on one line of a terminal, else a
# line for every tenth. Where the count begins anew, so does the progress.
set -euo pipefail

shown=0 percent=-1
while IFS= read -r line; do
  [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
  percent=$((100 * BASH_REMATCH[1] / BASH_REMATCH[2]))
  if [ -t 1 ]; then
    printf '\r  %3d %%' "$percent"
  elif ((percent / 10 != shown)); then
    shown=$((percent / 10))
    echo "  $percent %"
  fi
done
if [ -t 1 ] && [ "$percent" -ge 0 ]; then echo; fi
