"""Load increments of bodies whose normal and tangential problems are coupled."""
