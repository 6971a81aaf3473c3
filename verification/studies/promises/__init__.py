"""What the program promises under attack: each promise tried, counted and judged."""
