"""What the commands around baselines refuse."""


class BaselineRefused(Exception):
    """A baseline that cannot be read, or a report that must not become one."""
