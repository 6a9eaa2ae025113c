#!/usr/bin/env bash
# first_label.sh [--root FILE.tar] deb|source|all
# Times the first label from a bare Debian 12, as somebody has it who reads only the README: by the packages of
# examples/make_deb.sh (at most 2 minutes) and by examples/quickstart.sh (at most 6 minutes on two quiet cores). Says how long
# nothing was shown, too. Of the packages it also looks whether liboriel-dev alone is enough to build a program.
# Takes root, mmdebstrap or debootstrap, and the net; says `skipped` (exit code 77) where one is missing. FILE.tar is a bare
# root from earlier (mmdebstrap --variant=minbase bookworm FILE.tar); without it one is made, which is not timed.
set -euo pipefail
cd "$(dirname "$0")/../.."

tar=
if [ "${1:-}" = --root ]; then tar=$(realpath "$2"); shift 2; fi
ways=${1:-all}
[[ $ways =~ ^(deb|source|all)$ ]] || { sed -n 2p "$0" >&2; exit 2; }
[ "$(id -u)" -eq 0 ] || { echo "skipped: takes root"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
mirror=http://deb.debian.org/debian

bare_root() {
  mkdir -p "$1"
  if [ -n "$tar" ]; then
    tar -C "$1" -xf "$tar"
  elif command -v mmdebstrap >/dev/null; then
    mmdebstrap --variant=minbase bookworm "$1" $mirror
  elif command -v debootstrap >/dev/null; then
    debootstrap --variant=minbase bookworm "$1" $mirror
  else
    return 77
  fi >"$work/log" 2>&1
  cp /etc/resolv.conf "$1/etc/resolv.conf"
}

# inside ROOT COMMAND: runs it there, with /proc and /dev, in mounts that vanish with it.
inside() {
  unshare --mount --propagation slave bash -c '
    mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev" && exec chroot "$1" bash -c "cd /root && $2"' _ "$1" "$2"
}

# timed NAME LIMIT ROOT COMMAND: shows what it prints with the second at which it does; fails beyond the limit.
timed() {
  local name=$1 limit=$2 start=$EPOCHSECONDS now last=$EPOCHSECONDS silence=0 line previous="the beginning" after="the beginning" status=0
  echo "== $name"
  while IFS= read -r line; do
    now=$EPOCHSECONDS
    if ((now - last > silence)); then silence=$((now - last)) after=$previous; fi
    last=$now previous=${line:0:60}
    if [[ $line == "exit code "* ]]; then status=${line#exit code }; continue; fi
    printf '%4d s  %s\n' $((now - start)) "$line"
  done < <(inside "$3" "$4" 2>&1; echo "exit code $?")
  if [ "$status" != 0 ]; then echo "$name: failed"; return 1; fi
  echo "$name: first label after $((last - start)) s (at most $limit s); nothing was shown for $silence s after: $after"
  ((last - start <= limit))
}

from_deb() {
  local root=$work/deb debs=build/package/packages
  ls $debs/oriel_*.deb >/dev/null 2>&1 || examples/make_deb.sh
  bare_root "$root" || { [ $? -eq 77 ] && { echo "skipped: no mmdebstrap, no debootstrap"; exit 77; }; cat "$work/log"; exit 1; }
  mkdir "$root/root/packages"
  cp $debs/*.deb "$root/root/packages"
  timed "from the package" 120 "$root" "apt-get update && apt-get install -y ./packages/oriel_*.deb &&
    oriel label /usr/share/oriel/samples/house.stripped.city.json"
  inside "$root" "oriel --version && man -V 2>/dev/null; apt-get install -y -qq --no-install-recommends g++ make cmake ./packages/*.deb &&
    cmake -S /usr/share/doc/liboriel-dev/examples -B build && cmake --build build &&
    build/library /usr/share/oriel/samples/house.stripped.city.json labelled.city.json coarse.city.json" >"$work/log" 2>&1 ||
    { tail -n 40 "$work/log"; echo "liboriel-dev: no program builds with it"; return 1; }
  echo "liboriel-dev: a program builds with it and labels the sample"
}

from_source() {
  local root=$work/source
  bare_root "$root" || { [ $? -eq 77 ] && { echo "skipped: no mmdebstrap, no debootstrap"; exit 77; }; cat "$work/log"; exit 1; }
  mkdir "$root/root/oriel"
  git archive HEAD | tar -x -C "$root/root/oriel"
  timed "from the sources" 360 "$root" "bash oriel/examples/quickstart.sh"
}

if [ "$ways" != source ]; then from_deb; fi
if [ "$ways" != deb ]; then from_source; fi
