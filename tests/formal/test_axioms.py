"""What is accepted of Coq's answers to ``Print Assumptions``: known axioms, and nothing else.

The answers here are those of Coq 8.16.1 to the sources beside them; where Coq is installed, they
are made again.
"""

import shutil
from typing import NamedTuple

import pytest

from cap.errors import NotProved
from cap.formal import coq

CLASSIC = "Classical_Prop.classic : forall P : Prop, P \\/ ~ P"
FUNCTIONS = """\
From Coq Require ClassicalDedekindReals FunctionalExtensionality Classical_Prop.
Definition all := (ClassicalDedekindReals.sig_not_dec, ClassicalDedekindReals.sig_forall_dec,
  @FunctionalExtensionality.functional_extensionality_dep, Classical_Prop.classic).
"""
WRAPPED = """\
Axioms:
ClassicalDedekindReals.sig_not_dec
  : forall P : Prop, {~ ~ P} + {~ P}
ClassicalDedekindReals.sig_forall_dec
  : forall P : nat -> Prop,
    (forall n : nat, {P n} + {~ P n}) ->
    {n : nat | ~ P n} + {forall n : nat, P n}
FunctionalExtensionality.functional_extensionality_dep
  : forall (A : Type) (B : A -> Type)
      (f g : forall x : A, B x),
    (forall x : A, f x = g x) -> f = g
Classical_Prop.classic : forall P : Prop, P \\/ ~ P
"""
ONE_LINE_EACH = "\n".join(["Axioms:", *coq.CLASSICAL_REALS, ""])


class Said(NamedTuple):
    """Something that Coq is told, with options, and its answer."""

    told: str
    answer: str
    options: tuple[str, ...] = ()


def with_classic(before, false):
    """Return a proof of something false that uses the excluded middle, too."""
    return f"""From Coq Require Classical_Prop.
Definition middle := Classical_Prop.classic True.
{before}
Theorem proved : (True \\/ ~ True) /\\ False.
Proof. exact (conj middle ({false})). Qed.
Print Assumptions proved.
"""


MIDDLE = with_classic("", "0").replace(" /\\ False", "").replace("(conj middle (0))", "middle")
UNSOUND = {
    "a fixpoint, with an option": Said(
        with_classic(
            "Unset Guard Checking.\nFixpoint hole (n : nat) : False := hole n.\n"
            "Set Guard Checking.",
            "hole 0",
        ),
        f"Axioms:\nhole is assumed to be guarded.\n{CLASSIC}\n",
    ),
    "a fixpoint, with an attribute": Said(
        with_classic("#[bypass_check(guard)] Fixpoint hole (n : nat) : False := hole n.", "hole 0"),
        f"Axioms:\nhole is assumed to be guarded.\n{CLASSIC}\n",
    ),
    "an inductive type": Said(
        with_classic(
            "Unset Positivity Checking.\nInductive loop := Loop (_ : loop -> False).\n"
            "Definition no (x : loop) : False := match x with Loop f => f x end.",
            "no (Loop no)",
        ),
        f"Axioms:\nloop is assumed to be positive.\n{CLASSIC}\n",
    ),
    "universes": Said(
        with_classic(
            "Unset Universe Checking.\nDefinition U : Type := Type.\nDefinition u : U := U.\n"
            "Set Universe Checking.",
            "eq_refl : u = u",
        ).replace("/\\ False", "/\\ u = u"),
        f"Axioms:\nu relies on an unsafe hierarchy.\nU relies on an unsafe hierarchy.\n{CLASSIC}\n",
    ),
    "Type in Type": Said(
        MIDDLE,
        "Axioms:\nproved relies on an unsafe hierarchy.\nmiddle relies on an unsafe hierarchy.\n"
        f"{CLASSIC}\nTheory:\nType hierarchy is collapsed (logic is inconsistent)\n",
        ("-type-in-type",),
    ),
    "Set impredicative": Said(
        MIDDLE,
        f"Axioms:\n{CLASSIC}\nTheory:\nSet is impredicative\n",
        ("-impredicative-set",),
    ),
    "definitional UIP": Said(
        with_classic(
            "Set Definitional UIP.\n"
            "Inductive same (n : nat) : nat -> SProp := the_same : same n n.",
            "fun e => match e with the_same _ => eq_refl end",
        ).replace("/\\ False", "/\\ forall e : same 0 0, 0 = 0"),
        f"Axioms:\nsame relies on definitional UIP.\n{CLASSIC}\n",
    ),
    "an axiom": Said(
        with_classic("Axiom hole : False.", "hole"), f"Axioms:\nhole : False\n{CLASSIC}\n"
    ),
    "an axiom with a known name": Said(
        "Module Classical_Prop. Axiom classic : False. End Classical_Prop.\n"
        "Theorem proved : False.\nProof. exact Classical_Prop.classic. Qed.\n"
        "Print Assumptions proved.\n",
        "Axioms:\nClassical_Prop.classic : False\n",
    ),
    "no proof": Said(
        with_classic("Lemma hole : False. Admitted.", "hole"),
        f"Axioms:\nhole : False\n{CLASSIC}\n",
    ),
    "a module without a body": Said(
        with_classic(
            "Module Type M. Parameter hole : False. End M.\nDeclare Module N : M.", "N.hole"
        ),
        f"Axioms:\nN.hole : False\n{CLASSIC}\n",
    ),
    "a variable of a section": Said(
        with_classic("Section S.\nVariable hole : False.", "hole") + "End S.\n",
        f"Section Variables:\nhole\n: False\nAxioms:\n{CLASSIC}\n",
    ),
    "primitive integers": Said(
        with_classic(
            "From Coq Require PrimInt63.", "eq_refl : PrimInt63.int = PrimInt63.int"
        ).replace("/\\ False", "/\\ PrimInt63.int = PrimInt63.int"),
        f"Axioms:\nPrimInt63.int : Set\n{CLASSIC}\n",
    ),
    "another theorem, too": Said(
        MIDDLE + "Print Assumptions middle.\n", f"Axioms:\n{CLASSIC}\nAxioms:\n{CLASSIC}\n"
    ),
    "something else": Said(MIDDLE + "Check nat.\n", f"Axioms:\n{CLASSIC}\nnat\n     : Set\n"),
    "no axiom": Said(
        "Theorem proved : True.\nProof. exact I. Qed.\nPrint Assumptions proved.\n",
        "Closed under the global context\n",
    ),
    "nothing": Said("Theorem proved : True.\nProof. exact I. Qed.\n", ""),
}
SOUND = {
    "in lines of 200": Said(
        f"{FUNCTIONS}Set Printing Width 200.\nPrint Assumptions all.\n", ONE_LINE_EACH
    ),
    "in lines of 60": Said(f"{FUNCTIONS}Set Printing Width 60.\nPrint Assumptions all.\n", WRAPPED),
    "one of them": Said(MIDDLE, f"Axioms:\n{CLASSIC}\n"),
}


@pytest.mark.skipif(not shutil.which("coqc"), reason="Coq is not installed")
@pytest.mark.parametrize("said", [*UNSOUND.values(), *SOUND.values()], ids=[*UNSOUND, *SOUND])
def test_these_are_the_answers_of_coq(said, tmp_path):
    """Word by word, with exit status 0, although most of the theorems are false."""
    (tmp_path / "Told.v").write_text(said.told)
    assert coq.run([*coq.COMMAND, *said.options, "Told.v"], tmp_path) == (0, said.answer)


@pytest.mark.parametrize("said", SOUND.values(), ids=SOUND)
def test_the_axioms_of_the_reals_are_accepted_and_returned(said):
    """However their lines are broken; as Coq prints them, without the heading."""
    assert coq.axioms(coq.Answer(0, said.answer)) == said.answer.partition("\n")[2].rstrip()


@pytest.mark.parametrize("said", UNSOUND.values(), ids=UNSOUND)
def test_other_answers_are_refused(said):
    """In one line, which quotes what Coq says."""
    with pytest.raises(NotProved, match="axioms") as refused:
        coq.axioms(coq.Answer(0, said.answer))
    assert "\n" not in str(refused.value)


def test_the_refusal_quotes_what_coq_says():
    """Of a list, the first line that is no known axiom; else the first line."""
    for name, quoted in (
        ("a fixpoint, with an option", '"hole is assumed to be guarded."'),
        ("Set impredicative", '"Theory:"'),
        ("a variable of a section", '"Section Variables:"'),
        ("no axiom", '"Closed under the global context"'),
    ):
        with pytest.raises(NotProved, match="axioms") as refused:
            coq.axioms(coq.Answer(0, UNSOUND[name].answer))
        assert quoted in str(refused.value)


@pytest.mark.parametrize(
    "text",
    [
        WRAPPED.replace("Axioms:\n", "Axioms:\n  hole is assumed to be guarded.\n"),
        WRAPPED + "  and hole : False\n",
        WRAPPED.replace("{~ P}", "{P}"),
        WRAPPED.replace("P \\/ ~ P", "P"),
        WRAPPED.replace("classic : forall", "classic :\nforall"),
        "Warning: this is not quite so.\n" + WRAPPED,
        WRAPPED + "Warning: this is not quite so.\n",
        "Axioms:\n",
        WRAPPED.removeprefix("Axioms:\n"),
    ],
)
def test_every_word_of_the_answer_counts(text):
    """Types, continued lines, warnings before and after, a list without heading or axioms."""
    assert text != WRAPPED
    with pytest.raises(NotProved, match="axioms"):
        coq.axioms(coq.Answer(0, text))


def test_a_good_answer_of_a_program_that_failed_is_refused():
    """An exit status that is not 0 is no proof, whatever was printed."""
    with pytest.raises(NotProved, match="axioms"):
        coq.axioms(coq.Answer(1, WRAPPED))
