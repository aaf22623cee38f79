"""Shared set-up: the precision is checked around every test; the header names the versions."""

import gc
import platform
from importlib.metadata import version

import mpmath
import pytest
import repeated
from checker import remembered
from checker.forge import forge
from flint import ctx

from cap.flow.strobe import oscillator
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.sets import interval

PRECISION = 53


def pytest_report_header():
    """Name the versions whose arithmetic is tested."""
    libraries = ("python-flint", "mpmath", "numpy")
    found = ", ".join(f"{name} {version(name)}" for name in libraries)
    return f"arithmetic: {found}, python {platform.python_version()}"


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Leave what repeats other tests, or is long and guards no theorem, to the slow ones."""
    files = repeated.LIST, repeated.LENGTHY, repeated.LONGEST
    repeating, lengthy, longest = map(repeated.listed, files)
    for item in items:
        if item.nodeid in longest:
            item.add_marker(pytest.mark.beside)
        if item.nodeid in repeating | lengthy | longest:
            item.add_marker(pytest.mark.slow)


def pytest_collection_finish():
    """Let the garbage collector pass over the tests and the libraries, which stay to the end."""
    gc.collect()
    gc.freeze()


@pytest.fixture(autouse=True)
def scoped_precision():
    """Every test starts at 53 bits, and fails if it leaks another precision."""
    ctx.prec = PRECISION
    mpmath.mp.prec = PRECISION
    yield
    left = ctx.prec, mpmath.mp.prec
    ctx.prec = PRECISION
    mpmath.mp.prec = PRECISION
    assert left == (PRECISION, PRECISION)


@pytest.fixture
def paper():
    """The paper's oscillator, F = ω = 1, f = 2/5, walls ±1, over balls of 200 bits."""
    with interval.workprec(200):
        yield oscillator(PAPER)


ORBITS = {  # x, v and the times of the hits
    "elliptic": (0.1002798898441954, 0.5419433067664584, (1.0991729107, 3.5160904414)),
    "mirror": (0.55916325, 1.06697003, (0.3745, 4.2408)),
    "saddle": (0.34352606, 0.7753195, (0.6794, 3.821)),
    "second saddle": (-0.79144782, 0.49792004, (2.4622, 5.6038)),
}
STARTS = {name: Start.non_sticking(*orbit) for name, orbit in ORBITS.items()}


@pytest.fixture
def starts():
    """Rough guesses of the paper's four orbits with one hit of each wall."""
    return dict(STARTS)


@pytest.fixture(scope="session")
def good():
    """Return a valid certificate of the elliptic orbit."""
    return forge()


@pytest.fixture(scope="session")
def saddle():
    """Return a valid certificate of the saddle."""
    return forge("saddle")


@pytest.fixture(scope="module")
def orbits_computed_once():
    """Let the checker compute the orbits from a box once for equal arguments."""
    with remembered.orbits_computed_once():
        yield


@pytest.fixture(scope="module")
def releases_computed_once():
    """Let the checker compute the release map over an interval once for equal arguments."""
    with remembered.releases_computed_once():
        yield


@pytest.fixture(scope="module")
def pairs_computed_once():
    """Let the checker compute pairs of (1,1) orbits once for equal arguments."""
    with remembered.pairs_computed_once():
        yield


@pytest.fixture(scope="module")
def impacts_computed_once():
    """Let the checker compute the map and the flights of a ball once for equal arguments."""
    with remembered.impacts_computed_once():
        yield


@pytest.fixture(scope="module")
def legs_followed_once():
    """Let the checker follow the legs of a cell of orbits by contacts once for equal arguments."""
    with remembered.legs_followed_once():
        yield


@pytest.fixture(scope="module")
def release_cells_proved_once():
    """Let the checker prove a cell of times of releases once for equal arguments."""
    with remembered.release_cells_proved_once():
        yield


@pytest.fixture(scope="module")
def contacts_computed_once():
    """Let the checker read hints and compute Krawczyk's operator and jets of two masses once."""
    with remembered.contacts_computed_once(), remembered.hints_read_once():
        yield
