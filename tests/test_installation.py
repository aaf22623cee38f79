"""Installed, it is one package: what the wheel holds; and it works where nothing can be kept."""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from configparser import ConfigParser
from pathlib import Path

import pytest
from support import only

import cap

ROOT = Path(__file__).parent.parent
SCRIPTS = ("cap-prove", "cap-verify", "cap-explore", "cap-audit")
HOSTILE = 'raise SystemExit("a module of the user\'s folder was imported")\n'


def files(folder, *patterns):
    """Return the files of a folder of the tree, without what running it leaves there."""
    return {
        path.relative_to(folder).as_posix()
        for pattern in patterns
        for path in folder.rglob(pattern)
        if path.is_file() and "__pycache__" not in path.parts
    }


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """Build the wheel and unpack it, as an installer does; return the folder."""
    tree, site = (tmp_path_factory.mktemp(name) for name in ("tree", "site"))
    for name in ("cap", "proofs", "certificates"):
        ignored = shutil.ignore_patterns("__pycache__", "*.nbc", "*.nbi")
        shutil.copytree(ROOT / name, tree / name, symlinks=True, ignore=ignored)
    for name in ("pyproject.toml", "setup.py", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, tree)
    for link in ("proofs", "certificates"):
        (tree / "cap" / link).unlink()  # a system without links has none
    pip = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation"]
    words = [*pip, "--disable-pip-version-check", "-w", str(site), str(tree)]
    subprocess.run(words, check=True, env=clean(), stdout=subprocess.DEVNULL)
    (wheel,) = site.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(site)
    wheel.unlink()
    return site


def clean(**more):
    """Return the environment without the tree, and without a home."""
    gone = ("PYTHONPATH", "HOME", "XDG_CACHE_HOME", "NUMBA_CACHE_DIR", "MPLCONFIGDIR")
    return {name: value for name, value in os.environ.items() if name not in gone} | more


@pytest.fixture
def run(site, tmp_path):
    """Return a function that runs the installed package beside a hostile `proofs.py`."""
    for name in ("proofs.py", "checker.py", "certificates.py"):
        (tmp_path / name).write_text(HOSTILE)

    def ran(*words, **more):
        env = clean(PYTHONPATH=str(site), **more)
        return subprocess.run(
            [sys.executable, *words],
            cwd=tmp_path,
            env=env,
            capture_output=True,
            text=True,
            check=False,
        )

    return ran


def test_nothing_but_cap(site):
    """Only `cap`, and what describes it, enters site-packages."""
    found = {path.name.partition("-")[0] for path in site.iterdir()}
    assert found == {"cap", "cap_impact_friction"}


def test_every_module_is_there(site):
    """Every module of the tree, the proofs inside `cap`; every certificate, table and page."""
    cap_files = files(ROOT / "cap", "*.py", "*.json", "*.toml", "*/templates/*", "py.typed")
    proofs = files(ROOT / "proofs", "*.py", "*.md", "*.v", "Makefile")
    certificates = files(ROOT / "certificates", "*")
    inside = {f"proofs/{name}" for name in proofs} | {
        f"certificates/{name}" for name in certificates
    }
    assert files(site / "cap", "*") == cap_files | inside


def test_the_tree_has_the_same_names():
    """In a checkout, which needs no installation, links put both folders inside `cap`."""
    for name in ("proofs", "certificates"):
        link = ROOT / "cap" / name
        assert link.is_symlink()
        assert link.resolve() == ROOT / name
    assert Path(cap.__file__).parent == ROOT / "cap"


@pytest.fixture(scope="module")
def unlinked(tmp_path_factory):
    """Return a checkout as git makes it where there are no links: files with their targets."""
    tree = tmp_path_factory.mktemp("unlinked")
    ignored = shutil.ignore_patterns("__pycache__", "*.nbc", "*.nbi")
    for name in ("cap", "proofs", "certificates"):
        shutil.copytree(ROOT / name, tree / name, symlinks=True, ignore=ignored)
    for name in ("pyproject.toml", "setup.py", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, tree)
    for name in ("proofs", "certificates"):
        (tree / "cap" / name).unlink()
        (tree / "cap" / name).write_text(f"../{name}")
    return tree


@pytest.mark.slow
def test_a_checkout_without_links(unlinked):
    """It proves, knows stored certificates, and decides claims by them and by written proofs."""
    for words, told in (
        (("cap.prove", "saddle", "--out", "x.json"), "the independent checker accepts it"),
        (("cap.verify", "x.json", "saddle"), "VERIFIED"),
        (("cap.audit", "--only", "wellposed.no-accumulation", "--fresh"), "capture.json"),
        (("cap.audit", "--only", "strobe.forward-invariance", "--fresh"), "Audit of"),
        (("cap.certificate.format", "--check"), ""),
    ):
        done = subprocess.run(
            [sys.executable, "-m", *words],
            cwd=unlinked,
            env=clean(PYTHONPATH=str(unlinked), CAP_CACHE="cache"),
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        assert told in done.stdout


def test_an_editable_installation(unlinked, tmp_path):
    """It puts the tree on the path, where type checkers look, and runs no finder of its own."""
    code = "from setuptools import build_meta; print(build_meta.build_editable({!r}))"
    words = [sys.executable, "-c", code.format(str(tmp_path))]
    subprocess.run(words, cwd=unlinked, env=clean(), check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        (path,) = (name for name in archive.namelist() if "/" not in name)
        assert path.endswith(".pth")
        assert archive.read(path).decode().strip() == str(unlinked)


@pytest.mark.slow
def test_the_source_archive(tmp_path):
    """It has every file of the repository."""
    listed = subprocess.run(
        [shutil.which("git") or "git", "ls-files"],
        cwd=ROOT,
        check=False,
        capture_output=True,
        text=True,
    )
    if listed.returncode:
        pytest.skip("this is no repository")
    tree = tmp_path / "tree"
    for name in listed.stdout.splitlines():
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tree / name, follow_symlinks=False)
    code = "from setuptools import build_meta; print(build_meta.build_sdist('made'))"
    subprocess.run(
        [sys.executable, "-c", code], cwd=tree, env=clean(), check=True, capture_output=True
    )
    (made,) = (tree / "made").glob("*.tar.gz")
    shutil.unpack_archive(made, tmp_path / "unpacked", filter="data")
    (unpacked,) = (tmp_path / "unpacked").iterdir()
    missing = set(listed.stdout.splitlines()) - files(unpacked, "*", ".*")
    assert missing <= {"cap/proofs", "cap/certificates", ".gitignore"}


def test_links_on_a_registry(site):
    """The description has no link that would only hold inside the tree, and the others hold."""
    (info,) = site.glob("*.dist-info/METADATA")
    text = info.read_text(encoding="utf-8")
    links = re.findall(r"\]\(([^)]*)\)", text)
    source = re.search(r"^Project-URL: Source, (.*)$", text, re.MULTILINE)[1] + "/blob/main/"
    own = [link.removeprefix(source).partition("#")[0] for link in links if source in link]
    assert len(own) > 10
    assert all((ROOT / path).exists() for path in own)
    assert all(link.startswith(("https://", "http://", "#")) for link in links)


def test_the_scripts(site):
    """Each script calls a function that exists, and `pyproject.toml` names no other."""
    found = ConfigParser()
    found.read(next(site.glob("*.dist-info")) / "entry_points.txt")
    assert set(found["console_scripts"]) == set(SCRIPTS)


@pytest.mark.parametrize("script", only(SCRIPTS, "cap-verify"))
def test_version_and_name(run, site, script):
    """`--version` says the version, and `--help` the name by which the command was called."""
    (info,) = site.glob("*.dist-info")
    version = info.name.removesuffix(".dist-info").partition("-")[2]
    code = "from importlib.metadata import entry_points as e; import sys; sys.argv[0] = '{0}';"
    call = code.format(script) + "next(iter(e(group='console_scripts', name=sys.argv[0]))).load()()"
    assert run("-c", call, "--version").stdout == f"cap {version}\n" == f"cap {cap.__version__}\n"
    assert run("-c", call, "--help").stdout.startswith(f"usage: {script} ")
    module = script.replace("-", ".")
    assert run("-m", module, "--help").stdout.startswith("usage: python -m " + module)


def test_prove_and_verify(run, tmp_path):
    """A theorem is proved and verified far from the tree, by the modules and from Python."""
    proved = run("-m", "cap.prove", "saddle", "--out", ".")
    assert (proved.returncode, proved.stderr) == (0, "")
    verified = run("-m", "cap.verify", "saddle.json")
    assert verified.stdout.startswith("VERIFIED: ")
    code = "import cap; print(cap.verify_certificate('saddle.json'))"
    assert run("-c", code).stdout in verified.stdout.replace(' ("saddle.json")', "")


@pytest.mark.slow
def test_audit(run):
    """Claims are decided by the certificates and the written proofs that are installed."""
    for claim in ("wellposed.no-accumulation", "strobe.forward-invariance"):
        audited = run("-m", "cap.audit", "--only", claim, "--fresh", CAP_CACHE="cache")
        assert (audited.returncode, audited.stderr) == (0, ""), audited.stderr
