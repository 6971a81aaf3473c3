"""Whether the errors that runs state hold: scenes whose answer is known from elsewhere."""
