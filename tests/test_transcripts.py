"""What the commands print and write is what was accepted: one law over all commands and files.

A difference is a mistake, or is accepted with a reason: see `transcript.py`.
"""

import pytest
from transcript import differences, names, read, transcribe


@pytest.mark.parametrize("name", names())
def test_commands_print_and_write_what_was_accepted(name, tmp_path):
    commands, accepted = read(name)
    assert commands
    assert differences(accepted, transcribe(commands, tmp_path)) == []
