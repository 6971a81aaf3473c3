"""Load increments whose normal and tangential problems are coupled."""
