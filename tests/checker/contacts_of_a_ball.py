"""Test tools: a ball on a vibrating table, with g = 1, as a model and in a certificate of chaos."""

from __future__ import annotations

from fractions import Fraction

from cap.checker.kernel.shapes import matched
from cap.checker.system.given import SYSTEM, model
from cap.checker.theorems.contact_horseshoe import ContactHorseshoe

SETS = [
    ["-0.33371857826", "-6.82727339868", "0.223492771365", "-0.074519818464", "-0.100743958466",
     "-0.0723147318799"],
    ["-2.56493605857", "-8.383989482", "0.305587002924", "-0.107607982421", "0.112042393006",
     "0.0959484418646"],
    ["-1.5297667682", "-6.84975501667", "0.0587285762922", "-0.0177009948741", "0.0861675566537",
     "0.154714005599"],
    ["-0.485371721021", "-7.19588901821", "0.337232095906", "-0.0997748804804", "0.182019201595",
     "0.21081630012"],
]  # fmt: skip


def system(A="3/4", e="1"):
    """Return the system, as a certificate holds it."""
    A, e = Fraction(A), Fraction(e)
    table = {
        "value": [["1", "y"], [str(-A), "sin"]],
        "reset": {"v": [[str((1 + e) * A), "cos"], [str(-e), "v"]]},
        "to": ["fly"],
    }
    fly = {"field": {"y": [["1", "v"]], "v": [["-1"]]}, "guards": {"table": table}}
    return {"state": ["y", "v"], "omega": "1", "modes": {"fly": fly}}


def ball(A="3/4", e="1"):
    """Return the model."""
    return read(system(A, e))


def read(given):
    """Return the model of a system in a certificate."""
    return model(matched(given, SYSTEM, "the system"))


CHAOS = {
    "format": "cap-certificate/1",
    "theorem": "contact_horseshoe",
    "digits": "6",
    "parameters": system(),
    "claims": {
        "mode": "fly",
        "guard": "table",
        "growth": "1.32471795",
        "entropy": "0.28119956",
        "together": "1",
        "per_period": "0.10972385",
    },
    "hints": {
        "sets": SETS,
        "coverings": [["1"], ["2", "3"], ["0"], ["1"]],
        "vector": ["7548776662466927", "10000000000000000", "5698402909980532", "7548776662466927"],
        "middle": "-1.571",
        "times": ["17.107", "15.302", "14.198", "18.221"],
        "timed_vector": [
            "7417513976585226", "10000000000000000", "5788672322694718", "7274609041532312",
        ],
    },
    "cites": list(ContactHorseshoe.CITES),
    "provenance": {},
}  # fmt: skip
"""A family of four sets, as the prover finds it with --sets disjoint."""
