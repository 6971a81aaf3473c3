"""What the commands around baselines refuse."""

from contact_results.directory.refusal import Refused


class BaselineRefused(Refused):
    """A baseline that cannot be read, or a report that must not become one."""
