"""Lies that must be refused: in the numbers, in the theorem, in the law of motion, in a proof.

    python benchmarks/formal_mutants.py [CERTIFICATE]

One line for each mutant: where Coq refuses it, or ACCEPTED, and then the exit status is 1.  A
number is changed by one unit of its last digit or so; a false number in the data, where it is
computed, and a false number in the theorem alone, where it must be the one that was computed.  A
false definition in Statement.v must stop the library from compiling.  A file of the library that
compiles, but does not prove what it says, must be refused with the theorem.  Takes ten to twenty
minutes.
"""

import re
import shutil
import sys
import tempfile
from pathlib import Path

from cap import proofs
from cap.checker.kernel.certificate import Certificate, read
from cap.checker.kernel.shapes import Enclosure
from cap.errors import NotProved
from cap.formal import coq
from cap.formal.theorem import theorem

CERTIFICATE = Path(__file__).parents[1] / "certificates/elliptic.json"
ORBIT = {  # a claim, and the name of its field in Coq
    "box": "box_x",
    "least_speed": "least_speed",
    "hit_times": "hit_1",
    "hit_speeds": "speed_2",
    "hit_forcing": "forcing_1",
    "trace": "trace",
}
CLAIMS = {
    "elliptic": {
        **ORBIT,
        "jacobian": "taylor_x",
        "taylor": "taylor_v",
        "rotation_angle": "angle",
        "rotation_number": "rotation",
        "twist": "twist",
    },
    "saddle": {**ORBIT, "x": "state_x", "jacobian": "v_x", "multipliers": "inner"},
}
LAWS = {  # in Statement.v
    "friction drives": ("w * t) - f * sign", "w * t) + f * sign"),
    "another forcing": ("F * cos (w * t) - f", "F * sin (w * t) - f"),
    "the right wall lets pass": (
        "0 <= u /\\ filterlim v (at_left t) (locally u) /\\\n            v t = - e * u",
        "0 <= u /\\ filterlim v (at_left t) (locally u) /\\\n            v t = e * u",
    ),
    "half a period": ("Definition T : R := 2 * PI / w", "Definition T : R := PI / w"),
    "always to the right": ("a <= t <= b -> v t <> 0", "a <= t <= b -> 0 < v t"),
    "determinant -1": ("A * D - B * C = 1)", "A * D - B * C = -1)"),
    "order five of the remainder": (
        "order 4 (fun a b => f (x + a)",
        "order 5 (fun a b => f (x + a)",
    ),
    "the twist with the other sign": ("Theta + tau * (a", "Theta - tau * (a"),
    "no resonance of order five": ("1 <= k <= 4", "1 <= k <= 5"),
    "partly elastic": ("image F w f l r 1 in", "image F w f l r (1 / 2) in"),
    "positive eigenvalues": ("1 < Rabs m", "1 < m"),
}

HOLES = {  # before the last theorem in Checked.v, and in the place of its proof
    "a recursion without end": (
        "Unset Guard Checking.\nFixpoint hole (n : nat) : False := hole n.\nSet Guard Checking.\n",
        "destruct (hole 0).",
    ),
    "an axiom": ("Axiom hole : False.\n", "destruct hole."),
    "another meaning of the words": (
        "Definition {kind}_orbit (F w f l r : R) (c : {kind}_claims) : Prop := F = F.\n",
        "intros. reflexivity.",
    ),
}


def mutants(certificate: Certificate, text: str) -> dict[str, str]:
    """Return false theorems, by name."""
    lies = {} if certificate.theorem == "saddle" else _lies_of_the_bracket(text)
    lies |= {
        "f: 2/5 + 10^-31": text.replace(
            "f_ := Fraction 2 5", f"f_ := Decimal {4 * 10**30 + 1} 31"
        ).replace("(2 / 5)", "0.4000000000000000000000000000001"),
        "f, in the theorem alone": text.replace("(2 / 5)", "0.4000000000000000000000000000001"),
        "the right wall, in the theorem alone": text.replace("(2 / 5) (-1) 1", "(2 / 5) (-1) 1.1"),
    }
    for key, field in CLAIMS[certificate.theorem].items():
        lies[f"{field}: the last digit"] = theorem(_false(certificate, key))
        numbers = re.search(rf"\n +{field} := .*?(-?\d[\d.]+)(?:\)|;)", text, re.DOTALL)
        assert numbers is not None
        start, end = numbers.span(1)
        lies[f"{field}, in the theorem alone"] = text[:start] + _up(numbers[1], 1) + text[end:]
    assert all(lie != text for lie in lies.values())
    return lies


def _lies_of_the_bracket(text: str) -> dict[str, str]:
    return {
        "the bracket: its ends exchanged": re.sub(
            r"\bd_ := \((Decimal .*), (Decimal .*)\)", r"d_ := (\2, \1)", text
        ),
        "the bracket: one step aside": re.sub(
            r"\bd_ := \(Decimal \((-\d+)\) (\d+), Decimal \((-\d+)\) (\d+)\)", _aside, text
        ),
    }


def _aside(found: re.Match[str]) -> str:
    low, _, high, places = found.groups()
    return f"d_ := (Decimal ({int(low) - 1}) {places}, Decimal ({int(high) - 1}) {places})"


def _up(number: str, units: int) -> str:
    """Return a decimal with some units of its last digit more."""
    places = len(number.partition(".")[2])
    digits = str(abs(n := int(number.replace(".", "")) + units)).zfill(places + 1)
    return "-" * (n < 0) + f"{digits[:-places]}.{digits[-places:]}"


def _false(certificate: Certificate, key: str) -> Certificate:
    """Return the certificate with a claim moved by two units of its last digit, a box by 0.3."""
    units = {"box": 30000}.get(key, 2)

    def moved(claim: object) -> object:
        if isinstance(claim, Enclosure):
            return claim._replace(text=tuple(_up(end, units) for end in claim.text))
        if isinstance(claim, dict):
            return {name: moved(part) for name, part in claim.items()}
        return [moved(part) for part in claim]

    return certificate._replace(claims=certificate.claims | {key: moved(certificate.claims[key])})


def refused(text: str, library: Path) -> str:
    """Return where Coq refuses a file, or nothing."""
    answer = coq.prove(text, library)
    if not answer.status:
        return ""
    line = re.search(r"line (\d+)", answer.text)
    assert line is not None, answer
    return f"{text.splitlines()[int(line[1]) - 1].strip()[:60]}"


def law_refused(old: str, new: str, place: Path) -> str:
    """Return the file of the library that does not compile with a false definition, or nothing."""
    home = Path(proofs.__file__).with_name("formal")
    statement = (home / "Statement.v").read_text("utf-8")
    assert statement.count(old) >= 1, old
    for file in (*home.glob("*.v"), home / "Makefile"):
        shutil.copy(file, place)
    (place / "Statement.v").write_text(statement.replace(old, new))
    answer = coq.run(["make", "library"], place)
    return (re.findall(r'File "\./(\w+\.v)"', answer.text) or [""])[-1] if answer.status else ""


def hole_refused(kind: str, before: str, proof: str, text: str, place: Path) -> str:
    """Return why a theorem is refused that a hole in Checked.v would prove, or nothing."""
    file = place / "Checked.v"
    stated = re.compile(rf"(Theorem {kind}_checked .*?Proof\.).*?(Qed\.)", re.DOTALL)
    file.write_text(
        stated.sub(rf"{before.format(kind=kind)}\1 {proof} \2", file.read_text("utf-8"), count=1)
    )
    made = coq.run(["make", "library"], place)
    assert not made.status, made
    try:
        coq.axioms(coq.prove(text, place))
    except NotProved as reason:
        return str(reason)
    return ""


def main() -> int:
    """Print what becomes of each mutant."""
    certificate = read(Path(sys.argv[1] if sys.argv[1:] else CERTIFICATE).read_bytes())
    text, accepted = theorem(certificate), 0
    with coq.library(lambda *_: None) as library:
        assert not coq.prove(text, library).status, "the theorem itself is refused"
        for name, lie in mutants(certificate, text).items():
            accepted += not _told(name, refused(lie, library))
        for name, (before, proof) in HOLES.items():
            with tempfile.TemporaryDirectory() as place:
                copy = shutil.copytree(library, place, dirs_exist_ok=True)
                why = hole_refused(certificate.theorem, before, proof, text, Path(copy))
                accepted += not _told(f"Checked.v: {name}", why)
    for name, (old, new) in LAWS.items():
        with tempfile.TemporaryDirectory() as place:
            accepted += not _told(f"Statement.v: {name}", law_refused(old, new, Path(place)))
    print(f"{accepted} accepted")
    return int(accepted > 0)


def _told(name: str, where: str) -> str:
    print(f"{name:<45} {'refused: ' + where if where else 'ACCEPTED'}", flush=True)
    return where


if __name__ == "__main__":
    sys.exit(main())
