# What tests in a browser need: node, npm, Chromium, and packages of npm. Is sourced; a test whose tools are not there ends with
# `skipped` (exit code 77).

repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
missing=()
find_missing() {
  missing=()
  local program
  for program in node npm chromium; do command -v "$program" >/dev/null || missing+=("$program"); done
}

# Installs the programs that are missing, as Debian has them.
install_missing() {
  find_missing
  if [ ${#missing[@]} -gt 0 ]; then "$repository/examples/install_packages.sh" "${missing[@]/#node/nodejs}"; fi
}

need_programs() {
  find_missing
  if [ ${#missing[@]} -eq 0 ]; then return; fi
  echo "skipped: no ${missing[*]}; $0 --install installs it"
  exit 77
}

# need_packages FOLDER PACKAGES SECONDS: the packages that FOLDER/package-lock.json names, one version of each and its hash, stand in
# PACKAGES/node_modules afterwards.
need_packages() {
  local lock=$1/package-lock.json packages=$2
  mkdir -p "$packages"
  if cmp -s "$lock" "$packages/node_modules/lock"; then return; fi
  cp "$1/package.json" "$lock" "$packages/"
  if ! (cd "$packages" && timeout "$3" npm ci --no-audit --no-fund --ignore-scripts --fetch-retries=1 >npm.log 2>&1); then
    tail -3 "$packages/npm.log"
    echo "skipped: the packages cannot be had from the registry"
    exit 77
  fi
  cp "$lock" "$packages/node_modules/lock"
}
