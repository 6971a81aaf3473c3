"""The open challenge: other codes solve our problems and are judged as ours are."""
