"""Theorems on turning, sticking, capture and losses, from the command line to the numbers."""

import json
import re
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest
from mpmath import matrix, mp, mpf, workdps
from oracle_flow import System, orbit
from support import among, number, only, proving, rational, seeded

from cap.certificate.report import theorem as told
from cap.checker.verdict import check
from cap.parameters import Parameters
from cap.proofs import persistence

STORED = Path(__file__).parents[2] / "certificates"


def parameters(certificate):
    """Return the parameters that a certificate states."""
    return Parameters(**{name: Fraction(q) for name, q in certificate["parameters"].items()})


def numbers(value):
    """Give all strings of numbers in claims."""
    if isinstance(value, dict):
        value = value.values()
    if isinstance(value, str):
        yield value
    else:
        for inner in value:
            yield from numbers(inner)


def newton(p, x, v, periods):
    """Return the fixed point, events and Jacobian in mpmath, by Newton and divided differences."""
    end = rational(periods * System(p).T)
    step, z = mpf(10) ** (-mp.dps // 2), (mpf(x), mpf(v))
    for _ in range(8):
        events, here = orbit(p, 0, *map(rational, z), end)
        columns = []
        for dx, dv in ((step, 0), (0, step)):
            ahead = orbit(p, 0, rational(z[0] + dx), rational(z[1] + dv), end)[1]
            back = orbit(p, 0, rational(z[0] - dx), rational(z[1] - dv), end)[1]
            columns.append([(a - b) / (2 * step) for a, b in zip(ahead, back, strict=True)])
        J = matrix(columns).T
        defect = matrix([q - w for q, w in zip(here, z, strict=True)])
        change = mp.lu_solve(J - mp.eye(2), defect)
        z = z[0] - change[0], z[1] - change[1]
        if mp.norm(change) < mpf(10) ** (-mp.dps + 8):
            return z, events, J
    raise ArithmeticError("no convergence")


PERIODIC = {  # the command's words; a guess; n; the type
    "sink": (("--F", "3", "--orbit", ".4064", "-.6708"), "sink focus"),
    "saddle": (("--F", "3", "--orbit", "0.1992", "-1.4002"), "saddle"),
    "losses": (
        ("--F", "3", "--e", "9/10", "--mu", "1/20", "--orbit", ".547", "-1.111"),
        "sink focus",
    ),
    "two periods": (("--period", "2", "--orbit", "0.18826", "1.24032"), "saddle"),
    "elastic": (("--orbit", "0.1003", "0.5419"), "elliptic"),
    "stick": (("--F", "2", "--e", "3/5", "--orbit", "0.1447", "1.4118"), "superstable"),
}


def said(number, text):
    """Return whether a number stands in a text: as it is claimed, or as the same fraction."""
    exact = re.fullmatch(r"-?\d+(\.\d+)?", number) and str(Fraction(number))
    return number in text or bool(exact and exact in text)


def flowing(text):
    """Return a text without its lines."""
    return " ".join(text.split())


@pytest.mark.parametrize("name", only(PERIODIC, *(name for name in PERIODIC if name != "losses")))
def test_periodic_orbits(capsys, tmp_path, name):
    """The page has the numbers of the certificate, and they are those of an exact orbit."""
    words, kind = PERIODIC[name]
    path = tmp_path / "c.json"
    status, out, err = proving(capsys, "periodic", *words, "--digits", "10", "--out", str(path))
    assert (status, err) == (0, "")
    check(path.read_bytes(), lambda _step: None)
    certificate = json.loads(path.read_text("utf-8"))
    claims, p = certificate["claims"], parameters(certificate)
    assert claims["type"] == kind
    out = flowing(out)
    assert kind in out.partition("Theorem (periodic).")[2]
    assert ", ".join(claims["itinerary"]) in out
    assert flowing(told(certificate)) in out
    assert all(said(q, out) for key in claims for q in numbers(claims[key]))
    with workdps(40):
        z, events, J = newton(
            p, *(float(Fraction(claims[k][0])) for k in "xv"), int(claims["period"])
        )
        trace, det = J[0, 0] + J[1, 1], J[0, 0] * J[1, 1] - J[0, 1] * J[1, 0]
        close = Fraction(1, 10**18)
        for key, value in {"x": z[0], "v": z[1], "trace": trace, "determinant": det}.items():
            assert among(claims[key], value, close)
            low, high = map(Fraction, claims[key])
            assert high - low <= Fraction(1, 10**10) * max(1, abs(low), abs(high))
        assert claims["itinerary"] == [event.word for event in events]
        for pair, event in zip(claims["event_times"], events, strict=True):
            assert among(pair, event.time, close)
        hits = [event for event in events if event.word.startswith("hit")]
        for pair, event in zip(claims["hit_speeds"], hits, strict=True):
            assert among(pair, abs(event.before), close)
        forces = [abs(System(p).force(e.time)) for e in events if e.word.startswith("turn")]
        for pair, a in zip(claims["turning_factors"], forces, strict=True):
            assert among(pair, (a - number(p.f)) / (a + number(p.f)), close)
        for i in (0, 1):
            for j in (0, 1):
                assert among(claims["jacobian"][i][j], J[i, j], close)
        _multipliers(claims["multipliers"], trace, det, close)
        for key, value in zip("xv", z, strict=True):
            assert among(claims["box"][key], value, 0)
        if kind.startswith(("sink", "super")):
            _basin(p, claims, z)
        else:
            assert "basin" not in claims


def _multipliers(told, trace, det, close):
    """Check that the claimed multipliers are the zeros of the characteristic polynomial."""
    root = mp.sqrt(mp.mpc(trace * trace - 4 * det))
    pair = [(trace + root) / 2, (trace - root) / 2]
    if isinstance(told[0], dict):
        values = sorted(pair, key=lambda z: -z.imag)
        for each, z in zip(told, values, strict=True):
            assert among(each["re"], z.real, close)
            assert among(each["im"], z.imag, close)
    else:
        values = sorted((z.real for z in pair), key=lambda q: -abs(q))
        for each, z in zip(told, values, strict=True):
            assert among(each, z, close)


def _basin(p, claims, z):
    """Check that images of points of the ellipse are nearer by κ, and the ellipse is in the box."""
    (a, b), (c, d) = ((number(Fraction(q)) for q in row) for row in claims["basin"]["matrix"])
    W, kappa = matrix([[a, b], [c, d]]), number(Fraction(claims["basin"]["contraction"]))
    assert kappa < 1
    random, end = seeded(5), rational(int(claims["period"]) * System(p).T)
    for _ in range(6):
        angle = 2 * mp.pi * random.random()
        offset = mp.lu_solve(W, matrix([mp.cos(angle), mp.sin(angle)]))
        start = [z[0] + offset[0], z[1] + offset[1]]
        for key, q in zip("xv", start, strict=True):
            assert among(claims["box"][key], q, 0)
        events, last = orbit(p, 0, *map(rational, start), end)
        assert [event.word for event in events] == claims["itinerary"]
        assert mp.norm(W * matrix([last[0] - z[0], last[1] - z[1]])) <= kappa


@pytest.mark.parametrize("name", ["periodic-1", "periodic-4", "periodic-7", "persistence"])
def test_thirty_digits_of_stored_orbits(name):
    """Their thirtieth digits are those of Newton's method in mpmath."""
    certificate = json.loads((STORED / f"{name}.json").read_text("utf-8"))
    claims, p = certificate["claims"], parameters(certificate)
    with workdps(60):
        z, events, J = newton(
            p, *(float(Fraction(claims[k][0])) for k in "xv"), int(claims["period"])
        )
        det = number(p.e) ** (2 * len(claims["hit_speeds"])) * mp.exp(-number(p.mu) * System(p).T)
        for a in (abs(System(p).force(e.time)) for e in events if e.word.startswith("turn")):
            det *= (a - number(p.f)) / (a + number(p.f))
        values = {"x": z[0], "v": z[1], "trace": J[0, 0] + J[1, 1], "determinant": det}
        for key, value in values.items():
            assert among(claims[key], value, Fraction(1, 10**48 if key in "xv" else 10**29))
        for pair, event in zip(claims["event_times"], events, strict=True):
            assert among(pair, event.time, Fraction(1, 10**45))


CAPTURES = {
    "at the wall": (),
    "after a hit": ("--orbit", ".99", ".01"),
    "other parameters": ("--F", "2", "--omega", "3", "--f", "1", "--e", "9/10", "--mu", "1/10"),
    "the left wall": ("--e", "3/10", "--mu", "1/10", "--orbit", "-1/2", "-9/10"),
}


@pytest.mark.parametrize("name", only(CAPTURES, "other parameters"))
def test_captures(capsys, tmp_path, name):
    """Random states of the box: captured after the events told, when told, released when told."""
    path = tmp_path / "c.json"
    status, out, err = proving(capsys, "capture", *CAPTURES[name], "--out", str(path))
    assert (status, err) == (0, "")
    check(path.read_bytes(), lambda _step: None)
    certificate = json.loads(path.read_text("utf-8"))
    claims, p, random = certificate["claims"], parameters(certificate), seeded(8)
    out = flowing(out)
    assert flowing(told(certificate)) in out
    for key in ("accumulation_time", "release_time", "forcing", "ratio", "box"):
        assert all(said(q, out) for q in numbers(claims[key]))
    *before, capture, release = claims["itinerary"]
    until = Fraction(claims["release_time"][1]) + Fraction(1, 1000)
    side = 1 if claims["wall"] == "r" else -1
    with workdps(30):
        for _ in range(3):
            x, v = (
                low + (high - low) * Fraction(random.randint(1, 999), 1000)
                for low, high in (map(Fraction, claims["box"][k]) for k in "xv")
            )
            events, _ = orbit(p, 0, x, v, until)
            assert [event.word for event in events[: len(before)]] == before
            (at,) = [k for k, e in enumerate(events) if e.word.startswith("capture")]
            assert events[at].word == capture
            assert events[at + 1].word == release
            assert at + 2 == len(events)
            bounces = events[len(before) : at]
            assert {e.word.split()[0] for e in bounces} <= {"hit", "turn"}
            hits = [e for e in bounces if e.word.startswith("hit")]
            assert {e.word for e in hits} == {f"hit {claims['wall']}"}
            assert among(claims["accumulation_time"], events[at].time, 0)
            assert among(claims["release_time"], events[at + 1].time, Fraction(1, 10**25))
            for pair, event in zip(claims["event_times"], events[: len(before)], strict=False):
                assert among(pair, event.time, Fraction(1, 10**25))
            for hit in hits:
                assert among(claims["forcing"], side * System(p).force(hit.time), 0)
                assert hit.time <= number(Fraction(claims["accumulation_time"][1]))
            ratio = number(Fraction(claims["ratio"]))
            for one, other in pairwise(hits):
                assert abs(other.after) <= ratio * abs(one.after) * (1 + mpf(10) ** -12)


@pytest.mark.parametrize("digits", ["6", "10", "30", "100"])
def test_a_periodic_orbit_with_captures(capsys, tmp_path, digits):
    """Both walls catch the mass in every period: Φ is constant near P*, both multipliers are 0."""
    path = tmp_path / "c.json"
    words = ("--F", "2", "--e", "1/10", "--orbit", "-.2915", "1.4118", "--digits", digits)
    status, _, err = proving(capsys, "periodic", *words, "--out", str(path))
    assert (status, err) == (0, "")
    claims = json.loads(path.read_text("utf-8"))["claims"]
    assert claims["type"] == "superstable"
    assert [word for word in claims["itinerary"] if "capture" in word] == ["capture r", "capture l"]
    assert claims["determinant"] == ["0", "0"]
    assert all(Fraction(low) <= 0 <= Fraction(high) for low, high in claims["multipliers"])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "state"),
    [
        (("--l", "-3/20", "--r", "3/20", "--e", "3/10"), ("0.0437", "0.4528")),
        (("--F", "3", "--e", "3/10"), ("0.25967", "2.39839")),
        (("--F", "5", "--e", "1/5"), ("0.9498", "-0.29528")),
        (("--omega", "1/2", "--e", "1/4"), ("-0.22515", "0.9056")),
    ],
)
def test_captures_at_the_times_of_exact_orbits(capsys, tmp_path, words, state):
    """The accumulation lies in the interval claimed, and all other times in theirs."""
    path = tmp_path / "c.json"
    words = (*words, "--orbit", *state, "--digits", "10")
    assert proving(capsys, "periodic", *words, "--out", str(path))[0] == 0
    certificate = json.loads(path.read_text("utf-8"))
    claims, p = certificate["claims"], parameters(certificate)
    with workdps(30):
        x, v = (sum(map(Fraction, claims[key])) / 2 for key in "xv")
        events, _ = orbit(p, 0, x, v, rational(System(p).T))
        for word, times in zip(claims["itinerary"], claims["event_times"], strict=True):
            assert any(e.word == word and among(times, e.time, Fraction(1, 10**9)) for e in events)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "latest"),
    [
        (("--omega", "1e12"), 1.2e-12),
        (("--r", "1e30"), 1.2),
        (("--f", "0.999999"), 1.5e-3),
        (("--omega", "1e12", "--F", "1e24", "--f", "4e23", "--orbit", ".99", "1e10"), 1.2e-12),
    ],
)
def test_captures_in_other_units(capsys, tmp_path, words, latest):
    """Walls far away for the forcing; a wall that is pressed for a short time only."""
    path = tmp_path / "c.json"
    assert proving(capsys, "capture", *words, "--out", str(path))[0] == 0
    claims = json.loads(path.read_text("utf-8"))["claims"]
    assert 0 < Fraction(claims["accumulation_time"][1]) < latest
    assert Fraction(claims["ratio"]) < 1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("epsilon", "mu"),
    [
        ("1/3000", "1/7000"),
        *(
            pytest.param(*losses, marks=pytest.mark.slow)
            for losses in (("1/1000000", "0"), ("1/200", "1/200"))
        ),
    ],
)
def test_persistence_at_other_losses(capsys, tmp_path, monkeypatch, epsilon, mu):
    """Hardly any; no finite decimals; so many that it takes several cells to reach them."""
    monkeypatch.setattr(persistence, "MOST_CELLS", 4)
    path = tmp_path / "c.json"
    words = ("--epsilon", epsilon, "--mu", mu, "--digits", "10", "--out", str(path))
    assert proving(capsys, "persistence", *words)[0] == 0
    claims = json.loads(path.read_text("utf-8"))["claims"]
    assert Fraction(claims["basin"]["contraction"]) < 1
    assert Fraction(claims["range"]["epsilon"][-1]) >= Fraction(epsilon)
    assert Fraction(claims["range"]["mu"][-1]) >= Fraction(mu)


@pytest.mark.parametrize("e", ["1/2", "7/8", "0.75"])
def test_a_restitution_that_is_a_binary_number(capsys, tmp_path, e):
    """With hits only, the determinant is e to the fourth power, which a ball holds exactly."""
    path = tmp_path / "c.json"
    words = ("--e", e, "--orbit", "-0.7", "0.6", "--digits", "10", "--out", str(path))
    assert proving(capsys, "periodic", *words)[0] == 0
    claims = json.loads(path.read_text("utf-8"))["claims"]
    assert among(claims["determinant"], Fraction(e) ** (2 * len(claims["hit_speeds"])), 0)


@pytest.mark.slow
def test_all_orbits_and_their_files(capsys, tmp_path):
    """`--all` proves each of the orbits found, in files of their own."""
    words = ("periodic", "--F", "3/2", "--all", "--digits", "8", "--out", str(tmp_path))
    status, out, err = proving(capsys, *words)
    assert (status, err) == (0, "")
    files = [json.loads(path.read_text("utf-8")) for path in sorted(tmp_path.iterdir())]
    assert len(files) == 7
    assert out.count("Theorem (periodic)") == 7
    kinds = [c["claims"]["type"] for c in files]
    assert sorted(kinds) == ["flip saddle"] * 2 + ["saddle"] * 3 + ["sink focus"] * 2
    found = {round(float(Fraction(c["claims"]["x"][0])), 4) for c in files}
    assert found >= {-0.6283, 0.0002, 0.2656, 0.4463, 0.6276}
