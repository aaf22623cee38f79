"""Prove this: the prover beside the page, and the theorem that comes of it."""

import base64
import html
from abc import abstractmethod
from collections.abc import Callable
from typing import Any

from bokeh.layouts import column, row
from bokeh.models import Button, Checkbox, Div, Select, TextInput, UIElement

from cap.checker.theorems import load
from cap.errors import BadInput
from cap.explore.play.prover import News, Proof, Prove
from cap.floats.findings import State
from cap.parameters import Parameters
from cap.proofs.theorems import THEOREMS

NOT_HERE = ("masses",)  # groups: the page is about one mass
FORBIDDEN = ("journal", "out", "own", "executor", "progress", "theorem", "masses")
TITLES = {
    "proved": "Proved",
    "not proved": "Not proved: the theorem may still be true",
    "bad input": "There is nothing to prove",
    "failed": "The prover failed",
}

WRAPS = {"flex-wrap": "wrap"}  # what does not fit beside stands below
Ask = Callable[[], tuple[Any, State | None]]


class Panel:
    """The panel of proofs, one at a time.  ``ask`` gives what they are about, and a state clicked.

    ``names`` are the theorems, with a word on each; ``example`` of more options.
    """

    prove_with: Prove | None = None

    def __init__(self, ask: Ask, names: list[tuple[str, str]], example: str) -> None:
        self._ask, self._proof = ask, None
        first = "elliptic" if "elliptic" in dict(names) else names[0][0]
        self.choice = Select(title="Theorem", value=first, options=names, width=480)
        self.from_click = Checkbox(label="about the orbit near the state clicked", active=False)
        self.more = TextInput(
            title=f"more options, as on the command line: {example}",
            width=480,
            name="more",
        )
        self.begin = Button(label="prove this", button_type="primary", width=120, name="prove")
        self.end = Button(label="stop", width=80, disabled=True, name="stop")
        self.progress = Div(text="", width=260, name="progress")
        self.result = Div(text="", name="theorem", styles={"max-width": "860px"})
        self.begin.on_click(self.prove)
        self.end.on_click(self.stop)

    _proof: Proof | None

    def prove(self) -> None:
        """Begin a proof."""
        self.stop()
        try:
            options = self._options()
        except BadInput as error:
            self._finish(News("bad input", str(error)))
            return
        self._proof = Proof(str(self.choice.value), options, self.prove_with)
        self.begin.disabled, self.end.disabled = True, False
        self.result.text, self.progress.text = "", "the prover begins ..."

    def stop(self) -> None:
        """End the proof, if there is one, and say so."""
        if self._proof is not None:
            self.close()
            self._idle("stopped")

    def close(self) -> None:
        """End the proof, if there is one: nobody looks any more."""
        if self._proof is not None:
            self._proof.stop()
            self._proof = None

    def look(self) -> None:
        """Tell what the proof has told since the last time."""
        for news in self._proof.news() if self._proof else ():
            if news.kind == "progress":
                self.progress.text = html.escape(news.words)
            else:
                self._finish(news)
                return

    def shown(self) -> UIElement:
        """Return what is shown of it."""
        buttons = row([self.begin, self.end, self.progress])
        asked = column([self.choice, self.from_click, self.more, buttons])
        return row([asked, self.result], styles=WRAPS)

    def _options(self) -> dict[str, Any]:
        """Return the options of the proof; raise `BadInput` for what may not be asked from here."""
        p, state = self._ask()
        options = self._about(p)
        if self.from_click.active:
            if state is None:
                raise BadInput("no state has been clicked on")
            options["orbit"] = state
        for word in self.more.value.split():
            name, equals, value = word.partition("=")
            if not (equals and name.isidentifier()) or name in FORBIDDEN or name in options:
                raise BadInput(f"write an option as name=value, none of those above: {word!r}")
            options[name] = value
        return options

    @abstractmethod
    def _about(self, p: Any) -> dict[str, Any]:
        """Return the options that say what is explored."""

    def _finish(self, news: News) -> None:
        """Show how a proof has ended."""
        self.close()
        self._idle("")
        head = f"<h3>{TITLES[news.kind]}</h3>"
        if news.kind == "proved":  # what it says is escaped where it is written
            self.result.text = head + _download(news) + news.words
        else:
            self.result.text = f"{head}<p>{html.escape(news.words)}</p>"

    def _idle(self, words: str) -> None:
        self.begin.disabled, self.end.disabled = False, True
        self.progress.text = words


class Theorem(Panel):
    """The panel of proofs about the oscillator."""

    def __init__(self, ask: Ask) -> None:
        names = [(n, f"{n}: {t.summary}") for n, t in THEOREMS.items() if t.group not in NOT_HERE]
        super().__init__(ask, names, "digits=40 period=3")

    def _about(self, p: Parameters) -> dict[str, Any]:
        """Return the parameters, but those that the theorem varies."""
        options: dict[str, Any] = dict(p.strings())
        if "f" not in load(str(self.choice.value)).PARAMETERS:
            del options["f"]
        return options


def _download(news: News) -> str:
    """Return a link that saves the certificate, and how it is checked elsewhere."""
    data = base64.b64encode(news.certificate).decode("ascii")
    name = html.escape(f"{news.name}.json", quote=True)
    return (
        f'<p><a download="{name}" href="data:application/json;base64,{data}">save the certificate'
        f" {name}</a>; <code>python -m cap.verify {name}</code> checks it.</p>"
    )
