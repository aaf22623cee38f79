"""Pictures of diagnostics as graphs: entropy, exponents, rotation numbers."""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.ticker import FixedLocator, NullFormatter, StrMethodFormatter

from cap.floats.diagnostics.entropy import BasinEntropy
from cap.floats.diagnostics.lyapunov import Lyapunov
from cap.floats.diagnostics.rotation import SHAKY, Rotation
from cap.floats.findings import Floats
from cap.pictures.states import fates
from cap.pictures.style import BLACK, BLUE, CYCLE, GREY, ORANGE, RED, title


def entropy(findings: BasinEntropy, figure: FigureBase) -> None:
    """Draw the basin, and the entropies over the size of boxes."""
    axes = figure.subplots(1, 2)
    fates(axes[0], findings.basin[0])
    size = findings.sizes.astype(float)
    axes[1].loglog(size, np.full_like(size, math.log(2)), color=GREY, ls=":", label=r"$\log 2$")
    mean, boundary = (np.where(s > 0, s, np.nan) for s in (findings.mean, findings.boundary))
    axes[1].loglog(size, mean, "o-", ms=4, color=BLUE, label="$S_b$")
    axes[1].loglog(size, boundary, "s-", ms=4, color=RED, label="$S_{bb}$")
    if math.isfinite(findings.exponent):
        fit = np.exp(findings.intercept) * size**findings.exponent
        words = rf"$\propto \varepsilon^{{{findings.exponent:.3f} \pm {findings.error:.3f}}}$"
        axes[1].loglog(size, fit, "--", color=BLACK, lw=0.8, label=words)
    axes[1].set_xlabel(r"box size $\varepsilon$  [cells]")
    axes[1].set_ylabel("entropy  [nats]")
    for axis, ticks in ((axes[1].xaxis, (1, 2, 5, 10, 20, 50, 100, 200)),
                        (axes[1].yaxis, (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0))):  # fmt: skip
        axis.set_major_locator(FixedLocator(ticks))
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.set_minor_formatter(NullFormatter())
    axes[1].legend()
    title(figure, findings, "Basin entropy")


def lyapunov(findings: Lyapunov, figure: FigureBase) -> None:
    """Draw how the exponents converge."""
    axes = figure.subplots()
    for k, (start, values) in enumerate(zip(findings.starts, findings.exponents, strict=True)):
        colour = CYCLE[k % len(CYCLE)]
        ending = ", turns or sticks" if findings.turned[k] else ""
        label = f"$({start[0]:.4g}, {start[1]:.4g})${ending}"
        axes.semilogx(findings.after, values[:, 0], color=colour, lw=1.0, label=label)
        second = np.where(np.isfinite(values[:, 1]), values[:, 1], np.nan)
        axes.semilogx(findings.after, second, color=colour, lw=0.7, ls="--")
    axes.axhline(0, color=GREY, lw=0.6)
    larger = np.abs(findings.exponents[..., 0])
    top = float(larger[np.isfinite(larger)].max(initial=1e-12))
    axes.set_ylim(-1.3 * top, 1.3 * top)
    axes.set_xlabel("periods $n$")
    axes.set_ylabel(r"$\lambda_1$ (solid), $\lambda_2$ (dashed)  [1 / time]")
    if len(findings.starts) <= 10:
        axes.legend(title="orbit of")
    title(figure, findings, "Lyapunov exponents")


def rotation(findings: Rotation, figure: FigureBase) -> None:
    """Draw the rotation number over the distance, and near the fixed point over |z|²."""
    axes = figure.subplots(1, 2)
    good = findings.quality < SHAKY
    axes[0].plot(findings.distance[~good], findings.rotation[~good], ".", ms=3, color=ORANGE,
                 label="not settled: in a resonance, or chaotic")  # fmt: skip
    axes[0].plot(findings.distance[good], findings.rotation[good], ".", ms=3.5, color=BLUE,
                 label="on invariant curves, as far as one sees")  # fmt: skip
    _resonances(axes[0], findings.rotation[good])
    axes[0].set_xlabel("distance from $P_*$ along $x$  [length]")
    axes[0].set_ylabel(r"rotation number $\Theta/2\pi$ mod 1")
    axes[0].legend()
    near, first, second = findings.used, *findings.twist
    shift = 1e9 * (findings.rotation - findings.limit)
    axes[1].plot(
        findings.size[near] * 1e6,
        shift[near],
        "o",
        ms=3,
        mfc="white",
        mec=BLUE,
        mew=0.6,
        label="curves",
    )
    if near.any():
        z2 = np.linspace(0, float(findings.size[near].max()), 200)
        line, parabola = first * z2, first * z2 + second * z2**2
        axes[1].plot(z2 * 1e6, 1e9 * line / (2 * np.pi), "--", color=BLACK, lw=0.8,
                     label=rf"$\tau_1 = {first:.6f}$")  # fmt: skip
        axes[1].plot(z2 * 1e6, 1e9 * parabola / (2 * np.pi), color=RED, lw=0.8,
                     label=rf"$\tau_2 = {second:.6g}$")  # fmt: skip
    axes[1].set_xlabel(r"$|z|^2$ = area$/\pi$  [$10^{-6}$ length$^2$ / time]")
    axes[1].set_ylabel(r"rotation number $-\,\Theta_*/2\pi$  [$10^{-9}$]")
    axes[1].legend()
    title(
        figure, findings, rf"Rotation numbers around $P_*$, $\Theta_*/2\pi = {findings.limit:.9f}$"
    )


def _resonances(axes: Axes, numbers: Floats) -> None:
    """Mark the fractions with small denominators among the rotation numbers, on the right."""
    if not len(numbers):
        return
    low, high = float(numbers.min()), float(numbers.max())
    for q in range(2, 25):
        for p in range(1, q):
            if math.gcd(p, q) == 1 and low <= p / q <= high:
                axes.axhline(p / q, color=GREY, ls=":", lw=0.7)
                axes.annotate(f"{p}/{q}", (1, p / q), xycoords=("axes fraction", "data"),
                              xytext=(3, 0), textcoords="offset points", va="center",
                              fontsize=7.5, color="#555555")  # fmt: skip
