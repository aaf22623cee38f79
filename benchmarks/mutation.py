"""How many small errors in the checker do the tests notice?  Those that survive are listed.

    nice python benchmarks/mutation.py build/mutation [--jobs 2] [--only events] [--sample 0.1]
    nice python benchmarks/mutation.py build/slips --slips --since 1bc7956 --sample 0.0271 --seed 28
    nice python benchmarks/mutation.py build/slips --slips --only '(coverings|system).*: need.*pass'

Every mutant of `mutants.py`, or of `slips.py` with ``--slips``, is tried in a process of its own,
or a sample of the same part of each file: the second command tries 300, of files of which half is
new since a commit, and any smaller sample with this seed is a part of it.  The tests that execute
its line run, those that caught its neighbours first, then the quickest, until one fails or the
budget is spent.  First all tests run once, to note which lines each executes and to keep the
certificates that they forge.  The verdicts are kept in the folder, so a run can be interrupted: a
mutant that was caught is not tried again; one that survived and matters is, after new tests, of
which the lines are noted then (after changes of the checker remove `tests.json` in the folder).
The table counts caught mutants and survivors by module; `equivalent.txt` has those survivors that
no test can or need notice, each with its reason.

On 28 November 2026, of a sample of 150 of the whole checker (``--sample 0.00213 --seed 1141
--marks 'not slow and not browser'``, without ``--slips`` and with it), 22 did not matter, one was
ended by its time, the quick tests caught 115 of 127, and tests of the other 12 were added.  Of 223
`need`s of ``coverings`` and ``system``, each left out once, 211 were caught, 2 ended by their time,
3 did not matter; tests of the other 7, of which 3 bound the work, were added.

Since tests compare the numbers on the way to each verdict (``computed.py``), in samples of 95, 200
and 80 (seeds 2029, 2029, 2031), of 354 that matter the quick tests and those of ``computed.py``
caught 339, 96 %.  Since these look at variables and constants, too, and at all sentences: of 289
that matter, in a sample of 300 of both kinds (seed 3002), 285, 98.6 %; the other four have tests.

A whole run, of some 70 000 mutants, would take days on two cores; a sample of 150, half an hour.
mutmut and cosmic-ray were considered: they do not know that `lower` and `upper` can be exchanged or
an interval collapsed to its midpoint, and where tests are not chosen by line, and certificates not
forged once, a run takes days.
"""

from __future__ import annotations

import argparse
import builtins
import json
import os
import resource
import signal
import sys
import time
from collections import Counter, defaultdict
from importlib import import_module
from importlib.machinery import SourceFileLoader
from pathlib import Path
from random import Random
from re import search

import pytest
from mutants import Mutant, errors, marked, mutants
from sampled import ROOT, TARGET, drawn, files, table, unnoticed
from slips import slips

ROOMS = ("certificate", "checker")  # all of their tests
OTHERS = ("areas", "examples", "floats", "maps", "orbits", "particles", "release", "system", "tori")
CONSTANTS = "tests/checker/test_checker_computed.py::test_every_constant"  # it runs no line
SEEN = builtins.SEEN = set()  # (path, line) of the checker's statements that were executed
FIRST = 4
LOADED = (
    "cap.flow.strobe",
    "cap.maps.twist",
    "cap.one_one.transport",
    "cap.maps.fixed_point",
    "jsonschema",
    "mpmath",
)


class Runner:
    """A plugin of pytest: chosen tests in their order, each limited in time; what each executes."""

    def __init__(self, forged: dict[str, str], chosen: dict[str, float] | None = None) -> None:
        self.forged, self.chosen, self.failed, self.spent = forged, chosen, "", 0.0
        self.lines: dict[str, dict[str, list[int]]] = {}
        self.seconds: dict[str, float] = {}
        for file in (ROOT / "tests/checker").glob("forge*.py"):
            module = import_module(f"checker.{file.stem}")
            for name, function in list(vars(module).items()):
                if name.startswith("forge") and function.__module__ == module.__name__:
                    setattr(module, name, self.remembering(function))

    def remembering(self, function):
        """Return a function that makes each certificate once."""

        def forge(*arguments, **options):
            start, key = time.process_time(), repr((function.__name__, arguments, options))
            if key not in self.forged:
                self.forged[key] = json.dumps(function(*arguments, **options))
            self.spent += time.process_time() - start
            return json.loads(self.forged[key])

        return forge

    def run(self, files: list[str]) -> str:
        """Run the tests of files, and return the first that fails, or nothing."""
        options = ["-x", "-q", "--tb=no", "--assert=plain", "-o", "addopts="]
        for plugin in ("cacheprovider", "unraisableexception", "threadexception", "faulthandler"):
            options += ["-p", f"no:{plugin}"]
        limited(0 if self.chosen is None else 60)  # until the first test
        status = pytest.main([*options, *files], [self])
        return self.failed or ("" if status == 0 else f"status {status}")

    def run_in_order(self) -> str:
        """Run the chosen tests; those of the first few files alone before all others are loaded."""
        files = list(dict.fromkeys(test.split("::")[0] for test in self.chosen))
        failed = self.run(sorted(files[:FIRST]))
        if not failed and files[FIRST:]:
            self.chosen = {
                t: n for t, n in self.chosen.items() if t.split("::")[0] not in files[:FIRST]
            }
            failed = self.run(sorted(files[FIRST:]))
        return failed

    def pytest_collection_modifyitems(self, items):
        """Keep the chosen tests, in their order."""
        if self.chosen is not None:
            rank = {name: n for n, name in enumerate(self.chosen)}
            items[:] = sorted((i for i in items if i.nodeid in rank), key=lambda i: rank[i.nodeid])

    @pytest.hookimpl(hookwrapper=True)
    def pytest_runtest_protocol(self, item):
        """Note lines and seconds of a test, or end one that takes far too long."""
        start, before = time.process_time(), self.spent
        SEEN.clear()
        if self.chosen is not None:
            limited(10 + 20 * self.chosen[item.nodeid])
        yield
        self.seconds[item.nodeid] = time.process_time() - start - (self.spent - before)
        found = self.lines.setdefault(item.nodeid, defaultdict(list))
        for path, line in SEEN:
            found[str(Path(path).relative_to(ROOT))].append(line)

    def pytest_runtest_logreport(self, report):
        """Remember the test that failed."""
        self.failed = self.failed or (report.nodeid if report.failed else "")


def limited(seconds: float) -> None:
    """End this process after so many seconds of its own time, however busy the machine is."""
    signal.setitimer(signal.ITIMER_PROF, seconds)


def forked(action) -> int:
    """Start an action in a silent process of its own, and return the process."""
    pid = os.fork()
    if pid == 0:
        try:
            null = os.open(os.devnull, os.O_RDWR)
            os.dup2(null, 1)
            os.dup2(null, 2)
            action()
        finally:
            os._exit(0)
    return pid


def compiling(compiled) -> None:
    """Let modules be compiled by a function of name and path, unless it returns None."""
    original = SourceFileLoader.get_code

    def get_code(loader, name):
        code = compiled(name, Path(loader.path))
        return original(loader, name) if code is None else compile(code, loader.path, "exec")

    SourceFileLoader.get_code = get_code


def exercising() -> list[Path]:
    """Return the files of tests that exercise the checker in their own process.

    Those of proofs do as well, but accept what is true only, and after long proofs.
    """
    near = [path for room in ROOMS for path in (ROOT / "tests" / room).glob("test_*.py")]
    far = [path for room in OTHERS for path in (ROOT / "tests" / room).glob("test_*.py")]
    far.append(ROOT / "tests/proofs/test_cone_fields.py")
    words = "cap.checker", "cap.verify", "from checker", "import checker"
    return sorted(near + [path for path in far if any(w in path.read_text("utf-8") for w in words)])


def baseline(file: Path, marks: str) -> None:
    """Run all tests on the checker as it is; note lines, seconds and forged certificates.

    Of tests that were noted before only those are run of which the file is newer.
    """
    known = {"lines": {}, "seconds": {}, "forged": {}}
    noted = json.loads(file.read_text("utf-8")) if file.exists() else {"failed": "none was run"}
    known |= {} if noted["failed"] else noted
    since = 0.0 if noted["failed"] else file.stat().st_mtime
    new = [path for path in exercising() if path.stat().st_mtime > since]
    if not new:
        return
    compiling(lambda _, path: marked(path) if path.is_relative_to(ROOT / TARGET) else None)
    runner = Runner(known["forged"])
    failed = runner.run(["-m", marks, *map(str, new)])
    names = {str(path.relative_to(ROOT)) for path in new}
    for key, found_now in (("lines", runner.lines), ("seconds", runner.seconds)):
        old = {test: part for test, part in known[key].items() if test.split("::")[0] not in names}
        known[key] = old | found_now
    file.write_text(json.dumps(known | {"failed": failed, "forged": runner.forged}))


def attempt(mutant: Mutant, path: Path, chosen: dict[str, float], forged: dict, work: Path) -> None:
    """Run the chosen tests on a mutant, and write the one that fails."""
    resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
    text = mutant.source(path.read_text("utf-8"))
    compiling(lambda name, _: text if name == mutant.module else None)
    try:
        failed = Runner(forged, chosen).run_in_order()
    except Exception as error:  # noqa: BLE001 (it cannot be imported)
        failed = repr(error)
    (work / str(os.getpid())).write_text(failed)


class Trials:
    """Mutants and their verdicts, kept in a folder."""

    def __init__(self, work: Path, budget: float, marks: str) -> None:
        self.work, self.budget, self.verdicts = work, budget, work / "verdicts.jsonl"
        work.mkdir(parents=True, exist_ok=True)
        os.waitpid(forked(lambda: baseline(work / "tests.json", marks)), 0)
        known = json.loads((work / "tests.json").read_text("utf-8"))
        if known["failed"]:
            sys.exit(f"a test fails without a mutant: {known['failed']}")
        self.seconds, self.forged, self.lines = known["seconds"], known["forged"], known["lines"]
        self.kills: dict[str, Counter[str]] = defaultdict(Counter)
        self.by = dict[str, str]()  # the test that caught a mutant, or nothing
        if self.verdicts.exists():
            for name, by in map(json.loads, self.verdicts.read_text("utf-8").splitlines()):
                self.note(name, by)

    def note(self, name: str, by: str) -> None:
        """Note a verdict."""
        self.by[name] = by
        self.kills[name.split(":", maxsplit=1)[0]][by] += 1

    def chosen(self, mutant: Mutant, path: Path) -> dict[str, float]:
        """Return tests that execute the lines of a mutant, and their seconds, up to the budget."""
        file, kills = str(path.relative_to(ROOT)), self.kills[mutant.where]
        near = [test for test, found in self.lines.items() if file in found or test == CONSTANTS]
        # what is executed when the module is loaded matters to all of them
        tests = [test for test in near if mutant.line in self.lines[test].get(file, ())] or near
        tests.sort(key=lambda test: (-kills[test], self.seconds[test]))
        result, total = {}, 0.0
        for test in tests:
            total += self.seconds[test]
            if total <= self.budget or not result:
                result[test] = self.seconds[test]
        return result

    def run(self, todo: list[tuple[Mutant, Path]], jobs: int) -> None:
        """Try mutants, some at a time."""
        running = dict[int, Mutant]()
        for n, (mutant, path) in enumerate(todo):
            while len(running) >= jobs:
                self.finish(running)
            chosen = self.chosen(mutant, path)
            if not chosen:
                self.write(mutant, "")
                continue
            pid = forked(lambda: attempt(mutant, path, chosen, self.forged, self.work))  # noqa: B023
            running[pid] = mutant
            if n % 100 == 0:
                print(f"{n} of {len(todo)}", flush=True)
        while running:
            self.finish(running)

    def finish(self, running: dict[int, Mutant]) -> None:
        """Wait for one mutant, and write its verdict."""
        pid, status = os.wait()
        file = self.work / str(pid)
        by = file.read_text("utf-8") if file.exists() else f"status {status}"  # an alarm, no memory
        file.unlink(missing_ok=True)
        self.write(running.pop(pid), by)

    def write(self, mutant: Mutant, by: str) -> None:
        """Keep a verdict."""
        self.note(mutant.name, by)
        with self.verdicts.open("a") as file:
            file.write(json.dumps([mutant.name, by]) + "\n")
        if not by:
            print(f"survived: line {mutant.line}, {mutant.name}", flush=True)


def main() -> None:
    """Try the mutants that the command line asks for, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("work", type=Path, help="the folder for verdicts")
    parser.add_argument("--jobs", type=int, default=2, help="processes at a time (default 2)")
    parser.add_argument("--slips", action="store_true", help="mutants of the kinds of slips.py")
    parser.add_argument("--since", help="only files of which half is new since this commit")
    parser.add_argument("--only", default="", help="a pattern found in their modules and names")
    parser.add_argument("--sample", type=float, default=1, help="the part to be tried (default 1)")
    parser.add_argument("--seed", type=int, default=0, help="of the sample")
    parser.add_argument("--marks", default="", help="of the tests, as with pytest -m (default all)")
    parser.add_argument("--budget", type=float, default=60, help="seconds of tests for a mutant")
    options = parser.parse_args()
    sys.path[:0] = [str(ROOT), str(ROOT / "tests")]  # before the modules beside this one
    os.environ["PYTEST_DISABLE_PLUGIN_AUTOLOAD"] = "1"
    sys.pycache_prefix, sys.dont_write_bytecode = str(options.work / "pycache"), False
    pytest.main(["--version", "--noconftest"])  # loads its own modules once for all processes
    for name in LOADED:
        import_module(name)
    kinds = slips if options.slips else errors
    found = dict[Path, list[Mutant]]()
    for path in files(options.since):
        module = ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
        every = mutants(path, module, kinds)
        found[path] = [m for m in every if search(options.only, f"{module} {m.name}")]
    sample = drawn(found, options.sample, Random(options.seed))  # noqa: S311
    trials = Trials(options.work, options.budget, options.marks)
    done = {name for name, by in trials.by.items() if by} | (unnoticed() & trials.by.keys())
    todo = [(m, path) for m, path in sample if m.name not in done]
    trials.run(sorted(todo, key=lambda item: item[0].name in trials.by), options.jobs)
    print(table(sorted(m for m, _ in sample), trials.by))


if __name__ == "__main__":
    main()
