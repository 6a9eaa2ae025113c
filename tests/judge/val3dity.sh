#!/usr/bin/env bash
# Judges with val3dity every solid that `repair` and `generalise` write over all data sets, in files, in streams and
# alone: docs/validate.md, "Validation with val3dity". Run by hand.
#
#   bash tests/judge/val3dity.sh VAL3DITY DATA [WORD...]
#
# VAL3DITY is the path of its executable, DATA the folder of the data sets (../shared/data). WORDs choose sets and
# commands by parts of their names, such as 3dbag-2.2/generalise. $ORIEL is the command to judge.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
cd "$(dirname "$0")/../.."
exec python3 tests/judge/val3dity.py "${ORIEL:-build/release/cli/oriel}" "$@"
