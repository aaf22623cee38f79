"""The format's generated files, from the tables of the theorems:
``python -m cap.certificate.format [--check]``.

The JSON Schema, and the tables of ``certificates/FORMAT.md``, each between two marks:

    <!-- claims of elliptic -->
    <!-- end -->

With ``--check`` nothing is written, and the status is 1 if a file is stale.
"""

import json
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from cap.checker.kernel.alternatives import OneOrOther
from cap.checker.kernel.certificate import FIELDS
from cap.checker.kernel.choices import Cases, OrNone
from cap.checker.kernel.integers import Integer
from cap.checker.kernel.later import Later
from cap.checker.kernel.letters import Letters
from cap.checker.kernel.named import NAME, Named, name
from cap.checker.kernel.optional import First, Maybe
from cap.checker.kernel.reading import MAX_CHARACTERS, NUMBER, number, text
from cap.checker.kernel.shapes import Many, Quantity, Table, Whole, Word, bound, enclosure, region
from cap.checker.kernel.taken import Taken
from cap.checker.kernel.theorem import Theorem
from cap.checker.theorems import NAMES, load
from cap.files import replacing
from cap.tree import inside
from cap.words import say

HOME = inside("certificates")
SCHEMA, PAGE = HOME / "schema/certificate.schema.json", HOME / "FORMAT.md"

Json = dict[str, Any]
MARKED = r"<!-- (?P<what>\w+ of \w+) -->\n.*?<!-- end -->"
KINDS = ("claims", "hints", "cites")
SEVERAL = 4  # units in a cell of a table


def main(words: Sequence[str]) -> int:
    """Write the files, or check them; return the exit status."""
    stale, checked = [], "--check" in words
    for path, content in ((SCHEMA, schema_text()), (PAGE, page(PAGE.read_text("utf-8")))):
        if path.read_text("utf-8") != content:
            stale.append(path.name)
            if not checked:
                with replacing(path) as file:
                    file.write(content.encode())
    for file_name in stale:
        told = "is stale: python -m cap.certificate.format" if checked else "written"
        say(f"{file_name} {told}", sys.stdout)
    return int(bool(stale) and checked)


# the schema


def schema_text() -> str:
    """Return the JSON Schema of all certificates."""
    leaves: Json = {
        "number": {"type": "string", "pattern": f"^{NUMBER}$", "maxLength": MAX_CHARACTERS},
        "count": {"type": "string", "pattern": "^(0|[1-9][0-9]*)$", "maxLength": 6},
        "enclosure": _listed(_ref("number"), 2, 2),
        "name": {"type": "string", "pattern": f"^{NAME}$"},
        "cites": _cites(),
    }
    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A certificate of cap; its meaning is in certificates/FORMAT.md",
        "oneOf": [_ref(name) for name in NAMES],
        "$defs": leaves | {name: _certificate(name, load(name)) for name in NAMES},
    }
    return json.dumps(schema, indent=1) + "\n"


def _certificate(name: str, theorem: type[Theorem]) -> Json:
    """Return the schema of the certificates of a theorem."""
    return _object(
        {
            "format": {"const": "cap-certificate/1"},
            "theorem": {"const": name},
            "parameters": schema(theorem.PARAMETERS),
            "digits": schema(FIELDS["digits"]),
            "claims": schema({field.name: field.shape for field in theorem.CLAIMS}),
            "hints": schema({field.name: field.shape for field in theorem.HINTS}),
            "cites": _ref("cites"),
            "provenance": {"type": "object", "additionalProperties": {"type": "string"}},
        }
    )


def schema(shape: Any) -> Json:  # noqa: C901, PLR0911, PLR0912
    """Return the schema of the values of a shape."""
    match shape:
        case dict():
            optional = [key for key, part in shape.items() if isinstance(part, Maybe)]
            return _object({key: schema(part) for key, part in shape.items()}, optional)
        case list():
            same = all(part == shape[0] for part in shape)
            if same:
                return _listed(schema(shape[0]), len(shape), len(shape))
            return _listed(None, len(shape), len(shape)) | {"prefixItems": [*map(schema, shape)]}
        case Maybe() | Later():
            return schema(shape.shape)
        case Many(part, least, most):
            return _listed(schema(part), least, most)
        case Named(part, most):
            names = {"propertyNames": _ref("name"), "maxProperties": most}
            return {"type": "object", "additionalProperties": schema(part)} | names
        case First(parts):
            return _listed(None, 0, len(parts)) | {"prefixItems": [*map(schema, parts)]}
        case OrNone(part):
            return {"oneOf": [{"const": "none"}, schema(part)]}
        case OneOrOther(thing, other):
            return {"oneOf": [schema(thing), schema(other)]}
        case Cases(key, cases):
            kinds = [
                _object({key: {"const": name}} | schema(case)["properties"])
                for name, case in cases.items()
            ]
            return {"oneOf": kinds}
        case Word(words):
            return {"enum": list(words)}
        case Letters(letters, most):
            return {"type": "string", "pattern": f"^[{letters}]+$", "maxLength": most}
        case Quantity() | Taken():
            return _ref("enclosure")
        case Whole():
            return _ref("count")
        case Integer(digits):
            return {"type": "string", "pattern": f"^-?[0-9]{{1,{digits}}}$"}
    return _LEAVES[shape]


def _ref(name: str) -> Json:
    """Return a reference to a definition."""
    return {"$ref": f"#/$defs/{name}"}


_LEAVES = {
    number: _ref("number"),
    bound: _ref("number"),
    enclosure: _ref("enclosure"),
    region: _ref("enclosure"),
    text: {"type": "string"},
    name: _ref("name"),
}


def _object(properties: Mapping[str, Json], optional: Sequence[str] = ()) -> Json:
    """Return the schema of an object with these properties and no other."""
    return {
        "type": "object",
        "properties": dict(properties),
        "required": [key for key in properties if key not in optional],
        "additionalProperties": False,
    }


def _listed(item: Json | None, least: int, most: int) -> Json:
    """Return the schema of a list."""
    items = {} if item is None else {"items": item}
    return {"type": "array", **items, "minItems": least, "maxItems": most}


def _cites() -> Json:
    """Return the schema of citations."""
    word = {"type": "string"}
    words = {"type": "array", "items": word}
    hypothesis = _object({"name": word, "statement": word, "by": words})
    cited = _object(
        {
            "theorem": word,
            "reference": word,
            "hypotheses": {"type": "array", "items": hypothesis},
        }
    )
    return {"type": "array", "items": cited}


# the page


def page(old: str) -> str:
    """Return the page about the format with its tables as they should be."""

    def filled(mark: re.Match[str]) -> str:
        kind, name = mark["what"].split(" of ")
        table = "\n".join(_part(kind, load(name)))
        return f"<!-- {mark['what']} -->\n{table}\n<!-- end -->"

    marked = old + "".join(
        section(name) for name in NAMES if f"<!-- claims of {name} -->" not in old
    )
    return re.sub(MARKED, filled, marked, flags=re.DOTALL)


def section(name: str) -> str:
    """Return a section, still empty, on a theorem."""
    parameters = ", ".join(f"`{p}`" for p in load(name).PARAMETERS)
    marks = "".join(f"\n<!-- {kind} of {name} -->\n<!-- end -->\n" for kind in KINDS)
    return f"\n## `{name}`: its claims, hints and citations\nParameters: {parameters}.\n{marks}"


def _part(kind: str, theorem: type[Theorem]) -> Iterator[str]:
    """Give the lines of a table of a theorem, or of its citations."""
    if kind == "cites":
        return cited(theorem)
    return tabled({"claims": theorem.CLAIMS, "hints": theorem.HINTS}[kind], kind)


def tabled(table: Table, kind: str) -> Iterator[str]:
    """Give the lines of a table of claims or hints."""
    units = kind == "claims"
    yield "| key | form | meaning | unit |" if units else "| key | form | use |"
    yield "|---|---|---|---|" if units else "|---|---|---|"
    for field in table:
        cells = [f"`{field.name}`", form(field.shape), field.meaning]
        named = list(dict.fromkeys(_units(field.shape)))
        cells += [", ".join(named) if len(named) <= SEVERAL else "each its own"] if units else []
        yield "| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |"


def cited(theorem: type[Theorem]) -> Iterator[str]:
    """Give the lines of the citations of a theorem."""
    cites = theorem.CITES or theorem.cited(theorem.PARTS)
    for cite in cites:
        yield f"- `{cite['theorem']}` | `{cite['reference']}`"
        for hypothesis in cite["hypotheses"]:
            by = ", ".join(hypothesis["by"])
            yield f"  - `{hypothesis['name']}` | `{hypothesis['statement']}` | {by}"
    if not cites:
        yield "Nothing: the list is empty."


def form(shape: Any) -> str:  # noqa: C901, PLR0911, PLR0912
    """Return the form of a value in words."""
    match shape:
        case dict() if len(shape) > SEVERAL and all(isinstance(q, Maybe) for q in shape.values()):
            first, *_, last = shape
            return f"{{`{first}` .. `{last}`: {form(shape[first].shape)}}}"
        case dict():
            return "{" + ", ".join(f"`{key}`: {form(part)}" for key, part in shape.items()) + "}"
        case list() if all(form(part) == form(shape[0]) for part in shape):
            return f"{len(shape)} of ({form(shape[0])})"
        case list():
            return "[" + ", ".join(map(form, shape)) + "]"
        case Maybe(part):
            return f"{form(part)}, or missing"
        case Later():
            return form(shape.shape)
        case Many(part, least, most):
            return f"list of {least} to {most}: {form(part)}"
        case Named(part, most):
            return f"object of up to {most} names: {form(part)}"
        case First(parts):
            return f"list of up to {len(parts)}: {form(parts[0])}"
        case OrNone(part):
            return f'{form(part)}, or `"none"`'
        case OneOrOther(thing, other):
            return f"{form(thing)} or {form(other)}"
        case Cases(key, cases):
            kinds = (f'`{key}` `"{name}"`: {form(case)}' for name, case in cases.items())
            return " or ".join(kinds)
        case Letters(letters, most):
            return f"up to {most} letters of {letters}"
        case Word(words):
            return ", ".join(f'`"{word}"`' for word in words)
        case Whole(least, most):
            return f"{least} to {most}"
        case Integer(digits):
            return f"integer of up to {digits} digits"
        case Quantity():
            return "enclosure"
        case Taken(_, digits):
            return f"enclosure to {digits} digits"
    return {number: "number", bound: "upper bound", enclosure: "enclosure", region: "region"}.get(
        shape, "word"
    )


def _units(shape: Any) -> Iterator[str]:
    """Give the units of a shape; where no width rule holds there is none."""
    match shape:
        case Quantity(unit) | Taken(unit, _):
            yield "" if unit is None else unit or "1"
        case dict():
            parts = list(shape.values())
        case list():
            parts = shape
        case First(shapes):
            parts = list(shapes)
        case OneOrOther(part, _):
            parts = [part]
        case Maybe() | Later() | OrNone() | Many() | Named():
            parts = [shape.shape]
        case Cases(_, cases):
            parts = list(cases.values())
        case _:
            return
    if not isinstance(shape, Quantity | Taken):
        for part in parts:
            yield from _units(part)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
