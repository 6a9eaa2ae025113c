#!/usr/bin/env bash
# test.sh BUILD
# Packs the build tree BUILD by `cpack -G DEB`, looks at what the packages hold and need, and labels a sample with what they install.
# Says `skipped` (exit code 77) where a tool is missing. examples/make_deb.sh has lintian judge them; first_label.sh, beside this,
# installs them into a bare Debian.
set -euo pipefail
build=$(realpath "$1")

for tool in cpack dpkg-deb dpkg-shlibdeps file help2man gzip; do
  command -v "$tool" >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*" >&2; exit 1; }

# Compression is what takes time, and changes nothing here.
(cd "$build" && cpack -G DEB -B "$work" -D CPACK_DEBIAN_COMPRESSION_TYPE=none) >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }

root=$work/root
mkdir -p "$root/var/lib/dpkg"/{info,updates,triggers}
touch "$root/var/lib/dpkg/status"
packages=(oriel liboriel-dev oriel-doc)
# With ORIEL_PYTHON.
if compgen -G "$work/python3-oriel_*.deb" >/dev/null; then packages+=(python3-oriel); fi
for package in "${packages[@]}"; do
  deb=$(echo "$work/${package}"_*.deb)
  [ -f "$deb" ] || fail "no package $package"
  dpkg-deb --contents "$deb" | awk '{print $6}' | sed 's/^[.]//' >"$work/$package.list"
  if [ "$(id -u)" -eq 0 ]; then
    dpkg --root="$root" --force-depends --install "$deb" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
  else
    dpkg-deb --extract "$deb" "$root"
  fi
done

# holds PACKAGE PATH...: each path is in the package.
holds() {
  local package=$1 path
  for path in "${@:2}"; do
    grep -qxF "$path" "$work/$package.list" || fail "$package has no $path"
  done
}
holds oriel /usr/bin/oriel /usr/bin/oriel-generate /usr/share/icons/hicolor/scalable/apps/oriel.svg \
  /usr/share/man/man1/oriel.1.gz /usr/share/man/man1/oriel-generate.1.gz /usr/share/oriel/samples/first_pack.yaml \
  /usr/share/oriel/samples/house.stripped.city.json /usr/share/oriel/rules/residential.yaml
for word in $("$root/usr/bin/oriel" --help | awk '/^Subcommands:/ {on = 1; next} /^[^ ]/ {on = 0} on && /^  [a-z]/ {print $1}'); do
  holds oriel "/usr/share/man/man1/oriel-$word.1.gz"
done
holds oriel /usr/share/man/man1/oriel-rules-check.1.gz /usr/share/bash-completion/completions/oriel \
  /usr/share/zsh/vendor-completions/_oriel /usr/share/fish/vendor_completions.d/oriel.fish
holds liboriel-dev /usr/include/oriel/oriel/oriel.h /usr/share/doc/liboriel-dev/examples/main.cpp
grep -q '/liboriel[.]a$' "$work/liboriel-dev.list" || fail "liboriel-dev has no library"
grep -q '/cmake/oriel/oriel-config.cmake$' "$work/liboriel-dev.list" || fail "liboriel-dev has no file for find_package"
holds oriel-doc /usr/share/doc/oriel-doc/README.md /usr/share/doc/oriel-doc/docs/command.md
for package in "${packages[@]}"; do
  holds $package "/usr/share/doc/$package/copyright" "/usr/share/doc/$package/changelog.gz"
  if grep -vE '^/(usr/.*)?$' "$work/$package.list"; then fail "$package writes outside of /usr"; fi
done
# No file is in two packages.
twice=$(grep -hv '/$' "$work"/*.list | sort | uniq -d)
[ -z "$twice" ] || fail "in two packages: $twice"

needs=$(dpkg-deb --field "$work"/oriel_*.deb Depends)
timeout -s INT 3 "$root/usr/bin/oriel" studio --no-browser "$root/usr/share/oriel/samples/house.stripped.city.json" >"$work/address" 2>"$work/log" || true
grep -q '^http://127[.]0[.]0[.]1:' "$work/address" || { cat "$work/log" >&2; fail "the studio does not open"; }
for library in libc6 libyaml-cpp libsimdjson libopenmesh libtbb; do
  [[ $needs == *$library* ]] || fail "oriel does not depend on $library: $needs"
done

if [ -f "$work/python3-oriel.list" ]; then
  holds python3-oriel /usr/lib/python3/dist-packages/oriel/{__init__.py,_oriel.pyi,py.typed}
  needs=$(dpkg-deb --field "$work"/python3-oriel_*.deb Depends)
  for package in 'python3 (<< 3.' python3-numpy libyaml-cpp; do
    [[ $needs == *$package* ]] || fail "python3-oriel does not depend on $package: $needs"
  done
  house=$root/usr/share/oriel/samples/house.stripped.city.json
  PYTHONPATH=$root/usr/lib/python3/dist-packages /usr/bin/python3 -B -c "import oriel; oriel.write('$work/python.city.json', oriel.label('$house'))"
  "$root/usr/bin/oriel" label "$house" -o "$work/command.city.json" 2>"$work/log"
  cmp "$work/python.city.json" "$work/command.city.json"
fi

"$root/usr/bin/oriel" completion bash | cmp - "$root/usr/share/bash-completion/completions/oriel"

house=$root/usr/share/oriel/samples/house.stripped.city.json
"$root/usr/bin/oriel" label "$house" --rules "$root/usr/share/oriel/samples/first_pack.yaml" >"$work/labels" 2>"$work/log"
grep -q '  chimney  ' "$work/labels" || { cat "$work/labels" >&2; fail "the chimney of the sample has no label"; }
"$root/usr/bin/oriel-generate" -o "$work/houses"
[ -f "$work/houses/house.stripped.city.json" ] || fail "no house was made"
