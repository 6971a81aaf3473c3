"""A place where a march of the radial solver is kept once, as a file would keep it."""

import pickle
from typing import Any


class KeptStanding:
    """Keeps the standing after so many increments, and gives it back to whoever goes on."""

    def __init__(self, after: int, state: type) -> None:
        self.after, self.state, self.bytes = after, state, b""

    def last(self) -> Any:
        return pickle.loads(self.bytes) if self.bytes else None

    def keep(self, standing: Any) -> None:
        assert isinstance(standing.mark.state, self.state)
        if len(standing.increments) == self.after:
            self.bytes = pickle.dumps(standing)
