#!/usr/bin/env bash
# Says what changed since the baseline, in the log and on the page of the job.
# Warnings: a drift within the tolerances, and a level without a baseline (5).
# Failures: a verdict that begins to fail (1), a report of chosen cases or an unreadable file (2), and a
# number that is worse, more expensive or missing (7), unless it is accepted with a reason.
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
