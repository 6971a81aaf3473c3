"""What a penalty costs in accuracy and in work, by finite elements."""
