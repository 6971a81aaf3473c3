"""From a case to its verdicts."""
