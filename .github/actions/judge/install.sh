#!/usr/bin/env bash
# Installs slipstick beside the solver, with the versions that it was tested with. Their hashes are left out:
# with any of them pip refuses to install what is a folder, as slipstick is here.
set -euo pipefail

here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../../.." && pwd -P)
versions=$(mktemp)
sed -e 's/ *\\$//' -e '/--hash=/d' "$here/constraints.txt" >"$versions"
python -m pip install --quiet -c "$versions" "$here"
rm -f "$versions"
