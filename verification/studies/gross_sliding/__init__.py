"""Is 0.76 µW gross sliding? The study, its extrapolation, its verdicts and its figures."""
