"""Contact and friction by an augmented penalty at Gauss points."""
