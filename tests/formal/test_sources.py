"""What is in ``proofs/formal``: no word that weakens what Coq checks, or changes what it says.

Coq names most of these with the axioms, and `cap.formal.coq.axioms` refuses it then; a plugin, or
an option of printing, could change these words themselves.
"""

import re
from pathlib import Path

import pytest

from cap.formal import coq

HOME = Path(__file__).parents[2] / "proofs/formal"
COMMANDS = re.compile(  # that begin with a capital letter, and are good
    r"From (Coq|Coquelicot|Interval|Interval\.\w+|Cap) Require Import |Import ListNotations"
    r"|(Local )?Open Scope |Declare Scope |Create HintDb |#\[export\] Hint Resolve |Section |End "
    r"|Module \w+ := |Variables? |Hypothesis |Notation |Arguments |Ltac |Definition |Let |Record "
    r"|Fixpoint |Inductive |Lemma |Theorem |Proof$|Qed$"
)
WORDS = re.compile(  # in comments, too: a comment may end earlier than it seems
    r"\b(Unset|Set|bypass_check|admit|Admitted|give_up|Axioms?|Parameters?|Conjectures?|Context"
    r"|Primitive|Load|Redirect|ML|Coercion|native_\w+|vm_\w+|type.in.type|impredicative\w*)\b"
)
OF_SECTIONS = ("Variable", "Variables", "Hypothesis")  # axioms, outside of sections
BUILT = {".vo", ".vok", ".vos", ".glob", ".aux", ".cache", ".compiled", ".depend"}


def objections(text):
    """Return what is wrong with a file of Coq: words, commands, assumptions outside of sections."""
    wrong = [found[0] for found in WORDS.finditer(text)]
    depth = 0
    for sentence in re.split(r"\.(?=\s)", without_comments(text)):
        command = " ".join(re.sub(r"^(\d+:|[-+*{}\s])*", "", sentence).split())
        depth += command.startswith("Section ")
        depth -= command.startswith("End ")
        known = COMMANDS.match(command) or re.match("[a-z]|$|];", command)
        if not known or (command.split(" ")[0] in OF_SECTIONS and not depth):
            wrong.append(command)
    return wrong


def without_comments(text):
    """Return the text without its comments, which may be nested."""
    inner = re.compile(r"\(\*(?:(?!\(\*|\*\)).)*\*\)", re.DOTALL)
    while inner.search(text):
        text = inner.sub(" ", text)
    return text


def sources():
    """Return the files of the library."""
    return sorted(file for file in HOME.glob("*.v") if file.name != "Certified.v")


def test_no_file_weakens_what_coq_checks():
    """All commands of all files are known, and no word is of those that weaken."""
    assert len(sources()) > 40
    assert {
        file.name: found for file in sources() if (found := objections(file.read_text("utf-8")))
    } == {}


@pytest.mark.parametrize(
    "line",
    [
        "Unset Guard Checking.",
        "Unset Positivity Checking. Inductive loop := Loop (_ : loop -> False).",
        "#[bypass_check(guard)] Fixpoint hole (n : nat) : False := hole n.",
        "Lemma hole : False. Admitted.",
        "Lemma hole : False. Proof. admit. Qed.",
        "Axiom hole : False.",
        "(* a comment *) Parameter hole : False.",
        "Conjecture hole : False.",
        "Hypothesis hole : False.",
        "Section S. End S. Variable hole : False.",
        "Context (hole : False).",
        "Declare Module N : M.",
        'Declare ML Module "plugin".',
        "#[global] Set Printing Depth 1.",
        "Coercion hole : nat >-> Funclass.",
        "Canonical hole.",
        "#[global] Instance hole : False := hole.",
        "Load Hole.",
        'Redirect "hole" Print nat.',
        "Primitive hole := #int63_add.",
        "From Elsewhere Require Import Holes.",
    ],
)
def test_a_line_that_weakens_is_found(line):
    """At the end of a good file, such a line is an objection."""
    good = (HOME / "Moser.v").read_text("utf-8")
    assert objections(good) == []
    assert objections(f"{good}\n{line}\n")


def test_every_file_is_compiled_with_the_options_of_this_package():
    """One command, in the Makefile, without any option that weakens; no other file has options."""
    makefile = (HOME / "Makefile").read_text("utf-8")
    assert f"\nCOQC = {' '.join(coq.COMMAND)} -Q . Cap\n" in makefile
    assert re.findall(r"^\t.*COQC.*$", makefile, re.MULTILINE) == ["\t$(COQC) $<"]
    assert len(re.findall(r"\bcoqc\b", makefile)) == 1
    assert WORDS.findall(makefile) == []
    others = {file.name for file in HOME.iterdir() if file.suffix not in BUILT | {".v"}}
    assert others - BUILT == {"Makefile", "README.md"}
