#!/usr/bin/env bash
# Says what changed since the baseline, in the log and on the page of the job.
# A drift within what the references allow, and a level that nothing is recorded of (5), are warnings;
# what begins to fail (1), a report of chosen cases, and files that cannot be read (2), are failures, and
# so is what becomes worse or dearer within them (7): accept it with the reason, or mend it.
#
# usage: compare.sh REPORT
set -euo pipefail

report=$1
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
if [ -s "$report/summary.md" ]; then cat "$report/summary.md" >>"${GITHUB_STEP_SUMMARY:-/dev/stderr}"; fi
status=0
.venv/bin/slipstick maintain compare "$report" || status=$?
if [ "$status" = 5 ]; then
    echo "::warning title=Baseline drift::Numbers differ from the accepted ones, within their tolerances, or none" \
        "are accepted yet; if they are right: slipstick maintain baseline --accept --because '...' --from REPORT"
    status=0
fi
exit "$status"
