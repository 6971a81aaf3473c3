#!/usr/bin/env bash
# Judges SOLVER on CASES, or the folders in ANSWERS: sheets and badges in OUTPUT, tables in the log, one
# line of each on the page of the job. Ends with the first exit code that is not 0: 1 an error beyond its
# class or an omitted number, 2 what cannot be read, 3 a solver that gave up or raised, 6 what is open where STRICT is true,
# 7 what is worse than in AGAINST.
set -euo pipefail

options=()
if [ -n "${GRADE:-}" ]; then options+=(--class "$GRADE"); fi
if [ -n "${AGAINST:-}" ]; then options+=(--against "$AGAINST"); fi
if [ "${STRICT:-false}" = true ]; then options+=(--strict); fi
if [ "${PARTIAL:-false}" = true ]; then options+=(--partial); fi
read -ra cases <<<"${CASES:-}"
read -ra folders <<<"${ANSWERS:-}"
if [ -n "${SOLVER:-}" ] && [ ${#folders[@]} -gt 0 ] || [ -z "${SOLVER:-}${ANSWERS:-}" ]; then
    echo "give solver or answers, one of them" >&2
    exit 2
fi
status=0
judged() { # a name, then what to judge: no pipe, which would hide the exit code
    local sheet="${OUTPUT:-judged}/${1//\//-}/sheet.html" log code=0
    log=$(mktemp)
    "${SLIPSTICK:-slipstick}" judge "${@:2}" --page "$sheet" "${options[@]}" >"$log" || code=$?
    cat "$log"
    { grep -F " | " "$log" || echo "$1 | exit code $code"; } | sed 's/^/- /' >>"${GITHUB_STEP_SUMMARY:-/dev/stderr}"
    rm -f "$log"
    if [ "$status" = 0 ]; then status=$code; fi
}
if [ -n "${SOLVER:-}" ]; then
    for case in "${cases[@]}"; do judged "$case" "$SOLVER" --case "$case" --levels "${LEVELS:-4}" --seconds "${SECONDS_PER_LEVEL:-600}"; done
else
    for folder in "${folders[@]}"; do judged "$folder" "$folder"; done
fi
exit "$status"
