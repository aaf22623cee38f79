"""What other packagers read says the same as `pyproject.toml`; the article cites what it lists."""

import importlib.util
import re
import tomllib
from pathlib import Path

import cap

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_the_conda_recipe():
    """The same name, version, Python, libraries with their bounds, and scripts."""
    text = (ROOT / "packaging/conda/recipe.yaml").read_text(encoding="utf-8")
    assert f"\n  name: {PROJECT['name']}\n  version: {cap.__version__}\n" in text
    run = re.findall(r"^    - (\S+) (\S+)$", text.partition("  run:\n")[2], re.MULTILINE)
    names = {"matplotlib-base": "matplotlib"}
    stated = {names.get(name, name) + bounds for name, bounds in run}
    assert stated == {*PROJECT["dependencies"], f"python{PROJECT['requires-python']}"}
    scripts = dict(re.findall(r"^      - (\S+) = (\S+)$", text, re.MULTILINE))
    assert scripts == PROJECT["scripts"]


def test_urls_are_in_one_place():
    """Placeholders, until somebody publishes it."""
    others = [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), ROOT / "CITATION.cff"]
    assert all(url.startswith("https://example.org/") for url in PROJECT["urls"].values())
    assert [path for path in others if "example.org" in path.read_text(encoding="utf-8")] == []


def test_versions_of_python():
    """CI runs those that the classifiers name."""
    named = [c.rpartition(" ")[2] for c in PROJECT["classifiers"] if ":: 3." in c]
    text = (ROOT / ".github/workflows/ci.yml").read_text(encoding="utf-8")
    (matrix,) = re.findall(r"^        python: \[(.*)\]$", text, re.MULTILINE)
    assert re.findall(r'"(.*?)"', matrix) == named
    assert PROJECT["requires-python"] == f">={named[0]}"


def test_the_article():
    """It cites what its bibliography lists, and nothing else; and what the field has."""
    text = (ROOT / "paper/paper.md").read_text(encoding="utf-8")
    listed = re.findall(
        r"^@\w+\{(\w+),", (ROOT / "paper/paper.bib").read_text(encoding="utf-8"), re.MULTILINE
    )
    assert set(re.findall(r"@(\w+)", text.partition("# Summary")[2])) == set(listed)
    headings = re.findall(r"^# (.*)$", text, re.MULTILINE)  # those that the journal asks for
    assert headings == [
        "Summary",
        "Statement of need",
        "State of the field",
        "Software design",
        "Research impact statement",
        "AI usage disclosure",
        "References",
    ]
    assert 750 <= len(text.partition("# Summary")[2].split()) <= 1750


def test_what_a_release_needs():
    """A version without .dev, its heading among the changes, a tree without other changes."""
    path = ROOT / "packaging/release.py"
    spec = importlib.util.spec_from_file_location("release", path)
    assert spec is not None
    assert spec.loader is not None
    release = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(release)
    assert release.version() == cap.__version__
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    first = changes.partition("\n## ")[2].partition("\n")[0]
    assert release.refusals("0.1.0", changes, "") == []
    assert "is no release" in release.refusals("0.2.0.dev0", changes, "")[0]
    assert "no heading 9.9.9" in release.refusals("9.9.9", changes, "")[0]
    assert "not committed" in release.refusals("0.1.0", changes, " M README.md")[0]
    assert ("not yet released" in first) == (".dev" in cap.__version__)
