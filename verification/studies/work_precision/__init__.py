"""What accuracy costs: error against work, one curve for every method."""
