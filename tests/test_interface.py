"""The Python interface: what it returns, how exact it is, and how it fails."""

import inspect
import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from pathlib import Path

import pytest

import cap
from cap import prove
from cap.command.prover_parser import options_of, parser
from cap.interface import _below, _outwards
from cap.keywords import Options
from cap.proofs import theorems
from cap.system.files import read

CERTIFICATES = Path(__file__).parent.parent / "certificates"
BALL = Path(__file__).parent.parent / "examples/ball.py"


@pytest.fixture(scope="module")
def elliptic():
    """Return the elliptic theorem at the paper's parameters."""
    return cap.prove_theorem("elliptic", f="2/5", digits=30)


def test_it_is_what_the_command_proves(elliptic, tmp_path, capsys):
    """The same certificate as of `cap.prove`, but for its provenance, and the same words."""
    assert prove.main(["elliptic", "--f", "2/5", "--out", str(tmp_path)]) == 0
    written = json.loads((tmp_path / "elliptic.json").read_text("utf-8"))
    proved = dict(elliptic.certificate)
    assert {**written, "provenance": {}} == {**proved, "provenance": {}}
    assert elliptic.report() in capsys.readouterr().out


def test_the_claims_are_exact(elliptic):
    """Enclosures have the ends that the certificate states."""
    stated = elliptic.certificate["claims"]
    for name in ("x", "v", "trace", "twist"):
        claim = elliptic.claims[name]
        assert [claim.lower, claim.upper] == [Fraction(end) for end in stated[name]]
        assert str(claim) == f"[{', '.join(stated[name])}]"
        assert claim.width == claim.upper - claim.lower > 0
        assert claim.lower in claim
        assert claim.upper + claim.width not in claim
    assert elliptic.claims["remainder"]["radius"] == Fraction(stated["remainder"]["radius"])
    assert elliptic.parameters == dict(F=1, omega=1, f=Fraction(2, 5), l=-1, r=1)  # noqa: C408


def test_the_floats_are_outside(elliptic):
    """Each pair of doubles encloses the claim, and no narrower one does."""
    for name in ("x", "v", "trace", "twist", "rotation_number"):
        claim, (a, b) = elliptic.claims[name], elliptic.floats[name]
        assert Fraction(a) <= claim.lower <= claim.upper <= Fraction(b)
        assert claim.floats == (a, b)
    radius = elliptic.claims["remainder"]["radius"]
    a, b = elliptic.floats["remainder"]["radius"]
    assert Fraction(a) <= radius <= Fraction(b)
    assert len(elliptic.floats["hit_times"]) == 2


@pytest.mark.parametrize(
    "q",
    [
        *(Fraction(n, 7**k) for n in (-22, -1, 0, 1, 3) for k in (0, 1, 400)),
        Fraction(10) ** 400,
        -(Fraction(10) ** 400),
        Fraction(1, 4),
    ],
)
def test_rounding(q):
    """Down is the largest double that is not above, up its mirror image; of zero, zero."""
    a, b = _outwards(q, q)
    assert a <= q <= b
    assert b == -_below(-q)
    assert str(b) != "-0.0"
    if q == Fraction(1, 4):
        assert a == b == 0.25


def test_the_words_are_the_checkers(elliptic, tmp_path):
    """What is printed is the checker's verdict; a file written is verified with the same words."""
    path = tmp_path / "mine.json"
    elliptic.write(path)
    assert path.read_bytes() == elliptic.data
    again = cap.verify_certificate(path)
    assert str(again) == str(elliptic) == f"VERIFIED: {elliptic.sentence}"
    assert elliptic.steps[-1]
    assert repr(again) == "<Verified: elliptic at F = 1, omega = 1, f = 2/5, l = -1, r = 1>"
    assert r"\newcommand{\capEllipticTrace}" in again.latex()
    assert r"\newcommand{\capMineTrace}{[-0.4603, -0.4602]}" in again.latex("mine", 4)


@pytest.mark.parametrize("name", ["capture", "periodic-5", "pitchfork", "saddle", "symmetric-2"])
def test_a_stored_certificate(name):
    """All shapes of claims become exact numbers and outward pairs."""
    found = cap.verify_certificate(CERTIFICATES / f"{name}.json")
    assert found.claims.keys() == found.floats.keys() == found.certificate["claims"].keys()
    assert found.parameters.keys() == found.certificate["parameters"].keys()
    assert found.report().startswith(f"Theorem ({found.theorem})")


def test_other_orbits_and_numbers():
    """Parameters may be integers, fractions or strings; a guess may be floats."""
    F, f = 3, Fraction(2, 5)
    found = cap.prove_theorem("periodic", F=F, f=f, mu="0", orbit=(0.4, -0.67), digits=12)
    assert (found.parameters["F"], found.parameters["f"]) == (F, f)
    assert found.claims["type"] == "sink focus"
    assert Fraction("0.40") < found.claims["x"].lower < Fraction("0.41")


def test_masses():
    """A pair, or as on the command line; never doubles."""
    pair = cap.prove_theorem("sliding", masses=(1, Fraction(9, 10)), digits=6)
    text = cap.prove_theorem("sliding", masses="1,9/10", digits=6)
    assert pair.parameters["masses"] == text.parameters["masses"] == (1, Fraction(9, 10))
    assert repr(pair).endswith("masses = 1, 9/10>")
    with pytest.raises(cap.BadInput, match="binary double"):
        cap.prove_theorem("sliding", masses=(1, 0.9))


@pytest.mark.slow
def test_branch_on_an_executor():
    """The cells of `branch` are examined by the executor given, and progress is told."""
    told = []
    with ThreadPoolExecutor(1) as executor:
        found = cap.prove_theorem(
            "branch", lowest="0.465", executor=executor, progress=told.append, digits=8
        )
    assert found.claims["f_range"].lower == Fraction("0.465")
    assert any("cells" in words for words in told)


@pytest.mark.parametrize(
    ("options", "phrase"),
    [
        ({"f": 0.4}, 'write "0.4"'),
        ({"f": "two"}, "not a number"),
        ({"f": 2}, "below the forcing"),
        ({"friction": "2/5"}, "no option 'friction'"),
        ({"all": True}, "no option 'all'"),
        ({"out": "x.json"}, "no option 'out'"),
        ({"orbit": 0.1}, "pair (x, v)"),
        ({"order": 4}, "--order"),
        ({"period": 2}, "--period"),
        ({"digits": True}, "--digits"),
        ({"lowest": "2/5"}, "--from"),
        ({"f": float("nan")}, "f = nan is no number"),
    ],
)
def test_bad_input(options, phrase):
    """A request that makes no sense is `BadInput`, whose one line says what is wrong."""
    with pytest.raises(cap.BadInput) as failure:
        cap.prove_theorem("elliptic", **options)
    assert phrase in str(failure.value)
    assert "\n" not in str(failure.value)


def test_the_keywords():
    """The types know no option that no theorem declares; the signature knows what they know."""
    declared = {option.keyword for option in options_of(theorems.THEOREMS).values()}
    common = vars(parser().parse_args([])).keys() - {"theorem", "list", "all", "out", "own"}
    assert common <= Options.__annotations__.keys() <= declared | common
    listed = inspect.signature(cap.prove_theorem).parameters.keys()
    assert listed == {"theorem", "executor", "progress", *Options.__annotations__}


def test_what_there_is():
    """`dir` names what can be used, and loads nothing."""
    assert set(cap.__all__) <= set(dir(cap)) <= {*cap.__all__, "__version__", "__doc__"}


def test_a_picture_from_python():
    """What is found, its figure, its numbers, and how a notebook shows it."""
    picture = cap.figures.orbit((0.5, 1), exactly=True, f="9/20", periods=2)
    assert picture.findings.parameters.f == Fraction(9, 20)
    assert str(picture).startswith("orbit of (x, v) = (0.5, 1) at F = 1")
    assert picture._repr_png_().startswith(b"\x89PNG")
    assert len(picture.figure.axes) == 3
    assert repr(picture).startswith("<Picture: orbit of")
    with pytest.raises(cap.BadInput, match="binary double"):
        cap.figures.orbit(f=0.4)
    with pytest.raises(cap.BadInput, match="no picture 'portrat'"):
        cap.figures.draw("portrat")
    with pytest.raises(cap.BadInput, match="has no option 'orbits'"):
        cap.figures.draw("orbit", {"orbits": 3})
    with pytest.raises(cap.BadInput, match="no parameter 'g'"):
        cap.figures.draw("orbit", g=3)


def test_no_such_theorem():
    """The names of the theorems are said."""
    with pytest.raises(cap.BadInput, match=r"no theorem \"ellptic\": did you mean elliptic"):
        cap.prove_theorem("ellptic")


def test_not_proved(monkeypatch):
    """A step that does not succeed is `NotProved`."""
    monkeypatch.setattr(theorems, "PARTS", [])
    with pytest.raises(cap.NotProved, match="checker"):
        cap.prove_theorem("saddle")


@pytest.mark.parametrize("name", ["reject/twist_of_the_paper", "malformed/nan", "malformed/list"])
def test_a_rejected_certificate(name):
    """What the checker rejects is not proved; its reason is told."""
    path = Path(__file__).parent / f"certificates/{name}.json"
    with pytest.raises(cap.NotProved, match=r"the certificate is rejected: ."):
        cap.verify_certificate(path)


@pytest.mark.parametrize("name", ["", "nothing.json", "no\0name"])
def test_a_file_that_cannot_be_read(tmp_path, name):
    """A directory, or no file, is bad input, and no rejection."""
    with pytest.raises(cap.BadInput, match=r"^CANNOT READ: "):
        cap.verify_certificate(tmp_path / name)


def test_importing_is_fast():
    """`import cap` loads nothing: neither the prover nor the checker nor a library."""
    code = "import sys; before = set(sys.modules); import cap; print(*set(sys.modules) - before)"
    run = subprocess.run(
        [sys.executable, "-S", "-c", code], capture_output=True, text=True, check=True
    )
    names = run.stdout.split()
    assert [name for name in names if name.partition(".")[0] == "cap"] == ["cap"]
    assert not {"flint", "numpy", "sympy", "argparse", "json"} & set(names)


def test_the_names():
    """Each public name is found, and no other."""
    assert all(getattr(cap, name).__doc__ for name in cap.__all__)
    with pytest.raises(AttributeError, match="prove_everything"):
        cap.prove_everything  # noqa: B018


def test_the_checker_alone_is_loaded_to_verify():
    """Without any library: a certificate is verified from Python, and its numbers are shown."""
    code = """
import sys
for library in ("flint", "numpy", "numba", "sympy", "matplotlib"):
    sys.modules[library] = None  # so that to import it fails
import cap
assert not [name for name in sys.modules if name.startswith("cap.")]
verified = cap.verify_certificate(sys.argv[1])
print(verified, verified.report(), verified.latex(), verified.floats["trace"])
assert not [name for name in sys.modules if name.startswith(("cap.proofs", "cap.sets"))]
"""
    path = str(CERTIFICATES / "elliptic.json")
    done = subprocess.run(
        [sys.executable, "-c", code, path], capture_output=True, text=True, check=False
    )
    assert done.stderr == ""
    assert done.stdout.startswith("VERIFIED: ")


def test_an_orbit_of_an_own_system():
    """Found, proved and verified; it shows itself, and its numbers are enclosures."""
    proved = cap.prove_orbit(read(BALL, {"A": "13/10"}), digits=12)
    assert proved.theorem == "contacts"
    assert proved.claims["contacts"][0]["guard"] == "table"
    (time,) = proved.claims["times"]
    assert time.width < Fraction(1, 10**11)
    assert "VERIFIED" in proved._repr_html_()


@pytest.mark.parametrize(
    ("more", "why"),
    [
        ({"periods": 0}, "periods"),
        ({"digits": 1000}, "digits"),
        ({"state": (0.0, 0.0)}, "infinitely many contacts"),
        ({"state": (1.0, 0.0), "mode": "fall"}, "no mode 'fall'"),
    ],
)
def test_no_orbit_of_an_own_system(more, why):
    """A line says why."""
    with pytest.raises(cap.BadInput, match=why):
        cap.prove_orbit(read(BALL), **more)
