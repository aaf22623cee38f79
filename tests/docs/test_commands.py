"""The commands on the pages are understood, and print what the pages show."""

import re
import shlex
from pathlib import Path

import pytest

from cap import prove, verify
from cap.audit import command as audit
from cap.command import (
    archive,
    own,
    own_ball,
    own_basin,
    own_branch,
    own_capture,
    own_curve,
    own_horseshoe,
    verifier,
)
from cap.command.console import protected
from cap.command.prover_options import Asked
from cap.command.prover_parser import read, without_options
from cap.explore import certificate as picture
from cap.explore import explorer
from cap.explore.commands import COMMANDS
from cap.explore.model_commands import COMMANDS as MODEL_COMMANDS
from cap.explore.play import command as page
from cap.proofs.symbolic import NAMES
from cap.proofs.theorems import OWN, THEOREMS

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
PAGES = [page for page in PAGES if page.name not in ("tutorial.md", "audit.md")]
COMMAND = re.compile(r"^    python -m (cap[.\w]+) (.*?)(?:  .*)?$", re.MULTILINE)
ALL = [found for page in PAGES for found in COMMAND.findall(page.read_text(encoding="utf-8"))]


def block(page, first):
    """Return the lines of the indented block of a page that begins with ``first``."""
    lines = (ROOT / page).read_text(encoding="utf-8").splitlines()
    start = next(n for n, line in enumerate(lines) if line.startswith("    " + first))
    end = next(n for n in range(start, len(lines)) if lines[n] and not lines[n].startswith("    "))
    return [line.strip() for line in lines[start:end] if line.strip()]


def of_own(given):
    """Read a command about a system, a map, or a ball, of one's own."""
    if "--ball" in given or (given[0] == "island" and "--map" in given):
        command = own_ball if "--ball" in given else own_curve
        asked = command.asked(command.parser().parse_args(given))
    elif given[0] == "horseshoe":
        kind = own_horseshoe.MAP if "--map" in given else own_horseshoe.MODEL
        asked = own_horseshoe.asked(kind, own_horseshoe.parser(kind).parse_args(given))
    elif given[0] in ("capture", "basin", "branch"):
        command = {"capture": own_capture, "basin": own_basin, "branch": own_branch}[given[0]]
        asked = command.asked(command.parser().parse_args(given))
    else:
        assert own.Asked.of(own.parser().parse_args(given)).system.modes
        return
    assert asked.theorem in OWN


@pytest.mark.parametrize(("module", "words"), sorted(set(ALL)))
def test_a_command(module, words, monkeypatch):
    """Its options exist, and make sense together."""
    monkeypatch.chdir(ROOT)
    given = [protected(word) for word in shlex.split(words.replace("> audit.html", ""))]
    if module == "cap.prove":
        if "--help" in given:
            with pytest.raises(SystemExit, match="0"):
                read(given)
            return
        if {"--map", "--model", "--ball"} & {*given}:
            of_own(given)
            return
        options = read(given)
        if options.theorem in NAMES:
            assert without_options(options) is options
        else:
            kind = None if options.list else Asked.of(options, print).request.kind
            over_f = THEOREMS[options.theorem].over_f.name if options.theorem else None
            assert kind in (None, options.theorem, over_f)
    elif module == "cap.explore" and "--help" not in given:
        options = explorer.read(given)
        known = MODEL_COMMANDS if "--model" in given else (*COMMANDS, picture.NAME)
        assert options.paper or options.command in (*known, page.NAME)
    elif module == "cap.audit":
        audit.parser().parse_args(given)
    elif module == "cap.verify":
        options = verifier.parser().parse_args(given)
        small = [name for name in options.files if name == "elliptic" or "saddle" in name]
        assert verifier.main(small or ["saddle"]) == 0
    elif module == "cap.command.archive":
        assert archive.parser().parse_args(given).file.suffix == ".pyz"


def test_there_are_commands():
    """They are found: of each kind some."""
    known = {"cap.prove", "cap.verify", "cap.explore", "cap.audit", "cap.command.archive"}
    assert {module for module, _ in ALL} == known
    assert len(ALL) > 25


def test_the_verdict(capsys, monkeypatch):
    """`docs/certificates.md` shows the line of `cap.verify`, but for its wrapping."""
    monkeypatch.chdir(ROOT)
    assert verify.main(["certificates/elliptic.json"]) == 0
    assert " ".join(block("docs/certificates.md", "VERIFIED:")) == capsys.readouterr().out.strip()


@pytest.mark.slow
def test_shares_in_floats(capsys):
    """The page of `mixed` says what its command prints of where the states end, in floats."""
    shares = r"In floats the first two are ([.\d]+) and ([.\d]+), and ([.\d]+) never stops"
    text = (ROOT / "docs/theorems/mixed.md").read_text(encoding="utf-8")
    found = re.search(shares + r" \(`python -m cap\.explore (.*?)`", text)
    *stated, words = found.groups()
    assert explorer.main(shlex.split(words)) == 0
    printed = re.findall(r"^  \d +([.\d]+)%  (.*?)  ", capsys.readouterr().out, re.MULTILINE)
    assert [kind for _, kind in printed] == ["chaotic", "never hits a wall", "never turns"]
    for said, (share, _) in zip(stated, printed, strict=True):
        assert float(said) == pytest.approx(float(share) / 100, abs=6e-4)


def test_the_proof(capsys, tmp_path):
    """`docs/theorems.md` shows the first lines of `cap.prove elliptic`."""
    assert prove.main(["elliptic", "--out", str(tmp_path)]) == 0
    printed = [line.strip() for line in capsys.readouterr().out.splitlines() if line.strip()]
    shown = block("docs/theorems.md", "Found 2 elliptic orbits")
    assert shown == printed[: len(shown)]
