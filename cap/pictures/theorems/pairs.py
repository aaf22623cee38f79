"""Orbits with one hit of each wall per period: symmetric ones, and the pair that they bear."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from cap.checker.kernel.shapes import Enclosure
from cap.checker.kernel.theorem import Theorem
from cap.pictures.style import BLACK, BLUE, GREEN, GREY, ORANGE, PALE, PURPLE, RED
from cap.pictures.theorems.parts import heading, in_time, middle, number, system

COLOURS = {"+": ORANGE, "-": BLUE, None: GREY}  # of the sign of the twist
NAMES = {"saddle_center": "both are born", "pitchfork": "the pair is born",
         "minus_identity": r"$D\Phi = -1$"}  # fmt: skip
HITS = ("hit r", "hit l")
WIDE = 0.6  # in delta, of what is shown of the pair


def symmetric(theorem: Theorem, figure: Figure) -> None:
    """Draw both symmetric orbits in time, and where along f they change."""
    claims, p = theorem.claims, system(theorem)
    axes = figure.subplot_mosaic([["plus", "minus"], ["f", "f"]], height_ratios=[2, 1])
    for name, branch in claims["branches"].items():
        if branch is None or branch["genuine"] == "no":
            axes[name].set_axis_off()
            words = "there is none" if branch is None else "its velocity changes sign: none"
            axes[name].set_title(f"the orbit '{name}': {words} (proved)")
            continue
        state = middle(branch["x"]), middle(branch["v"])
        in_time(axes[name], p, state, list(zip(HITS, branch["hit_times"], strict=True)), 1)
        trace = number(branch["trace"])
        axes[name].set_title(f"the orbit '{name}': {branch['type']}, trace {trace} (proved)")
        axes[name].legend(loc="lower left", fontsize=7.5)
    line = axes["f"]
    for k, (name, words) in enumerate(NAMES.items()):
        if claims[name] is not None:
            at = middle(claims[name])
            line.axvline(at, color=(RED, GREEN, PURPLE)[k], lw=1.2)
            line.annotate(f"{words}\n$f = $ {number(claims[name])}", (at, 0.9 - 0.3 * k),
                          xycoords=("data", "axes fraction"), xytext=(4, 0), fontsize=8,
                          textcoords="offset points", va="top")  # fmt: skip
    line.axvline(float(p.f), color=BLACK, lw=1.2, ls="--")
    line.annotate("this $f$", (float(p.f), 0.06), xycoords=("data", "axes fraction"), fontsize=8,
                  xytext=(4, 0), textcoords="offset points")  # fmt: skip
    line.set(yticks=[], xlabel="friction $f$  [force]", xlim=(0, float(p.F)))
    line.set_title("along $f$, at the same other parameters (proved)")
    heading(figure, theorem, "All symmetric orbits with one hit of each wall")


def pitchfork(theorem: Theorem, figure: Figure) -> None:
    """Draw the orbit at the birth of the pair, and the pair near it, to leading order."""
    claims = theorem.claims
    p = system(theorem, f=(claims["f"].lower + claims["f"].upper) / 2)
    axes = figure.subplot_mosaic([["time", "time"], ["f", "trace"]])
    state = middle(claims["x"]), middle(claims["v"])
    in_time(axes["time"], p, state, list(zip(HITS, claims["hit_times"], strict=True)), 1)
    axes["time"].set_title("the orbit from which the pair branches off")
    delta = np.linspace(-WIDE, WIDE, 121)
    f0, bend, trace = (middle(claims[k]) for k in ("f", "curvature", "trace_curvature"))
    axes["f"].axhline(0, color=BLACK, lw=1.0, label=r"symmetric: $\delta = 0$ (proved)")
    axes["f"].plot(f0 + bend * delta**2, delta, color=BLUE, ls="--",
                   label=r"the pair: $f_0 + p\delta^2$, the leading term (proved)")  # fmt: skip
    axes["f"].plot(f0, 0, "o", ms=6, mfc=RED, mec=BLACK, label=f"$f_0$ = {number(claims['f'])}")
    axes["f"].set(xlabel="friction $f$  [force]", ylabel=r"$\delta$")
    axes["f"].set_title(rf"$p$ = {number(claims['curvature'])}")
    axes["trace"].plot(delta, 2 + trace * delta**2, color=BLUE, ls="--")
    axes["trace"].axhspan(-2, 2, color=PALE, lw=0, zorder=0, label="elliptic: between -2 and 2")
    axes["trace"].set(xlabel=r"$\delta$", ylabel="trace", ylim=(-2.5, 3.5))
    words = rf"trace $2 + q\delta^2$, the leading term, $q$ = {number(claims['trace_curvature'])}"
    axes["trace"].set_title(words)
    handles = [h for name in axes for h in axes[name].get_legend_handles_labels()[0]]
    figure.legend(handles=handles, loc="outside lower center", ncols=3)
    heading(figure, theorem, r"A pitchfork: times between hits $(\pi \pm 2\delta)/\omega$",
            but=("f",))  # fmt: skip


def branch(theorem: Theorem, figure: Figure) -> None:
    """Draw the trace over f in cells, each an enclosure, and the least speed below."""
    claims = theorem.claims
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2.4, 1])
    for cell in claims["cells"]:
        for axes, name in ((above, "trace"), (below, "least_speed")):
            _cell(axes, cell["f"], cell[name], COLOURS[cell["twist"]])
    for k, each in enumerate(claims["resonances"]):
        above.axvline(middle(each["f"]), color=GREY, lw=0.6, zorder=0)
        above.annotate(str(each["ratio"]), (middle(each["f"]), 1.0 - 0.05 * (k % 2)), fontsize=7.5,
                       xycoords=("data", "axes fraction"), ha="center", va="top")  # fmt: skip
    for gap in claims["exceptions"]:
        above.axvspan(float(gap.lower), float(gap.upper), color=RED, alpha=0.5, lw=1.5)
    above.axhline(-2, color=GREY, lw=0.6)
    above.axhline(2, color=GREY, lw=0.6)
    ends = [("f_start", "born"), ("f_end", "least speed 0")]
    told = [f"{words} at $f$ = {number(claims[k])}" for k, words in ends if claims[k] is not None]
    above.set(ylabel="trace of $D\\Phi$", title=f"{'; '.join(told)} (proved)")
    below.set(xlabel="friction $f$  [force]", ylabel="least speed\n[length / time]")
    handles = [
        Patch(fc=ORANGE, label=r"twist $\tau_1 > 0$"),
        Patch(fc=BLUE, label=r"twist $\tau_1 < 0$"),
        Patch(fc=GREY, label="no sign proved"),
        Patch(fc=RED, alpha=0.5, label="Moser's theorem may fail"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    heading(figure, theorem, "The pairs over $f$: in each cell what is proved of all its $f$; "
            "numbers: resonances $p/q$", but=("f",))  # fmt: skip


def _cell(axes: Axes, f: Enclosure, y: Enclosure, colour: str) -> None:
    """Draw what a quantity takes over a range of f."""
    a, b, c, d = (float(q) for q in (*f[:2], *y[:2]))
    axes.add_patch(Rectangle((a, c), b - a, d - c, fc=colour, ec=colour, lw=0.8))
    axes.autoscale_view()
