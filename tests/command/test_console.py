"""What the command lines share."""

import importlib

import pytest

COMMANDS = {
    "cap.audit.command": (),
    "cap.command.verifier": ("elliptic",),
    "cap.command.prover": ("map_curve", "--map", "examples/maps/standard.py"),
    "cap.explore.explorer": ("certificate", "elliptic"),
}


@pytest.mark.parametrize("jobs", ["0", "1025", "-1", "1/2", "two", "\N{SUPERSCRIPT TWO}"])
@pytest.mark.parametrize("command", COMMANDS)
def test_a_number_of_processes_that_is_none(command, jobs, capsys):
    """One line, and status 2, whatever the command."""
    with pytest.raises(SystemExit) as end:
        importlib.import_module(command).main([*COMMANDS[command], "--jobs", jobs])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert said.startswith("error: argument --jobs: ")
    assert said.count("\n") == 1
