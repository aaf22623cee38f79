"""From a first portrait to a certified theorem in eleven steps: it makes `tutorial.md`.

``python docs/tutorial.py`` runs it and writes the page and its pictures; ``--check`` compares.
"""

# ruff: noqa: E402 (a cell imports what it shows)

import sys

from render import main

if __name__ == "__main__":
    sys.exit(main(__file__))

# %% [markdown]
# # From a first portrait to a certified theorem in eleven steps
#
# A mass slides with dry friction between two walls and is forced periodically:
#
#     x'' = F cos(ωt) - f sgn(x'),    l < x < r,    v → -v at the walls,    T = 2π/ω
#
# A mass at rest stays at rest as long as |F cos ωt| ≤ f.  One looks at the mass once per forcing
# period: the map Φ that takes its state (x, v) at t = 0 to its state at t = T is the *stroboscopic
# map*.  A fixed point of Φ is a T-periodic orbit.
#
# Steps 1 to 7 explore: they compute with ordinary floating-point numbers, and **prove nothing**.
# Steps 8 to 10 prove: they compute with enclosures, sets that are guaranteed to contain the true
# number, and a second program checks the result.  What is only seen in a picture is not called
# proved here. Step 11 does both for two masses.
#
# Install the package as the README says, and make a directory `pictures`. Then all commands and all
# lines of Python below can be copied, in their order; each takes seconds. The parameters that are
# not given are those of the paper: F = 1, ω = 1, f = 2/5, walls at -1 and 1, so the distance of the
# walls is R = 2.  This page is printed by `docs/tutorial.py`, which runs every command in it.

# %% [markdown]
# ## 1. The system and one orbit
#
# Without a starting state, `orbit` searches for an elliptic fixed point, P\*, and shows its orbit.

# %%
# !python -m cap.explore orbit --out pictures/orbit.svg

# %% [markdown]
# ![The orbit of the elliptic fixed point](pictures/orbit.svg)
#
# On the left are position and velocity over one period: the mass hits the right wall, then the left
# wall, and comes back to where it was.  On the right is the same orbit in the plane of position and
# velocity; the star is P\*, and the velocity stays away from zero, though it comes near to it after
# the hit at the left wall.
#
# That the velocity is never zero matters.  Friction is smooth as long as the mass moves, and then Φ
# preserves area; where a mass turns or sticks, Φ shrinks areas.

# %% [markdown]
# ## 2. A portrait around P\*
#
# Start sixty orbits, spread over an ellipse around P\*, and plot each of them once per period.

# %%
# !python -m cap.explore portrait --orbits 60 --periods 300 --dpi 120 --out pictures/portrait.png

# %% [markdown]
# ![Stroboscopic portrait around the elliptic fixed point](pictures/portrait.png)
#
# The coloured points are orbits that never turned in 300 periods; many of them seem to lie on
# closed curves around the star.  The grey points belong to orbits that turned or stuck, and those
# appear outside.
#
# This is what one sees around an elliptic point of an area-preserving map.  The picture does not
# prove that even one of these curves exists: 300 periods are not for ever, and a float is not a
# real number.

# %% [markdown]
# ## 3. The whole plane: who turns, who sticks, who is captured
#
# A mass *turns* when its velocity vanishes between the walls and it moves on at once; it *sticks*
# when it then stays at rest for a time; it is *captured* when it hits one wall again and again,
# infinitely often in finite time, and comes to rest there.

# %%
# !python -m cap.explore basin --box -1 1 -2 2 --points 250 --periods 25 --out pictures/basin.svg

# %% [markdown]
# ![The fates of the states of the plane](pictures/basin.svg)
#
# On the left each state has the colour of the last line of the list that applies to its orbit
# within 25 periods: nearly all stick, and the two blue islands, where the orbits do not even turn,
# lie around P\* and around the fixed point of the mirror orbit. (The mirror symmetry is (x, v, t) →
# (-x, -v, t + T/2).)  On the right the colour is the time of the first turn, stick or capture: it
# is short almost everywhere, and long in thin layers near the islands and along curves that lead
# there.
#
# The engine behind this picture follows any array of states, and finds the events without time
# steps:

# %%
import numpy as np

from cap.floats.engine import swarm
from cap.parameters import PAPER

states = np.array([(0.1, 0.55), (0.5, 0.5), (0.999, 0.01), (0.0, 0.0)])
orbits = swarm.follow(PAPER, states, periods=25)
print("     x      v   hits   first turn   first stick   first capture")
for k, (x, v) in enumerate(states):
    times = [orbits.first_time(kind)[k] for kind in ("turn", "stick", "capture")]
    words = "".join(f"{'never' if np.isnan(t) else f't = {t:.4f}':>14}" for t in times)
    print(f"{x:6.3f} {v:6.3f} {orbits.count('hit')[k]:6}{words}")

# %% [markdown]
# The first of these states lies near P\* and only hits the walls, twice per period.  The third
# begins close to the right wall and is captured there at once.  The last begins at rest in the
# middle.

# %% [markdown]
# ## 4. SALI: regular or chaotic?
#
# Two deviations carried along an orbit turn into the same direction exponentially fast if the orbit
# is chaotic, and only slowly if it is regular.  SALI measures how far they are from being parallel.

# %%
# !python -m cap.explore sali --points 120 --periods 25 --out pictures/sali.svg

# %% [markdown]
# ![SALI around the elliptic fixed point](pictures/sali.svg)
#
# On the left is the island around P\* (the white star): SALI is largest (dark blue) inside, falls
# towards the rim, and is smallest (yellow) at states scattered outside, whose orbits have not
# turned yet; where they have, the picture is grey. On the right SALI is followed for a thousand
# periods along the orbits of the coloured dots: nearest to the star it stays between 0.1 and 1.5,
# and on the other two it falls along straight lines in this plot with two logarithmic axes, so like
# a power of the number of periods, as it does on regular orbits.
#
# The words *regular* and *chaotic* of the output mean above and below the threshold, 10⁻²·⁵ (the
# dotted line), after this number of periods, and no more: on the right two orbits end below it that
# fall like regular ones. Look at the slope before you believe the word. (`-inf` says that the two
# deviations of some orbit became parallel to the last digit.)

# %% [markdown]
# ## 5. Rotation number and twist, from curves alone
#
# On an invariant curve, Φ turns by a mean angle per period: 2π times the rotation number.  How that
# number changes from curve to curve, the *twist*, is what Moser's theorem asks about.

# %%
# !python -m cap.explore rotation --orbits 100 --radius 0.02 --out pictures/rotation.svg

# %% [markdown]
# ![Rotation number against the distance from the fixed point](pictures/rotation.svg)
#
# On the left the rotation number falls with the distance from P\*, with a plateau at 2/7, where the
# orbits are caught in a resonance. On the right one is so near P\* that the unit is 10⁻⁹: the
# rotation number first rises and then falls; the dashed line has the slope that belongs to τ₁, and
# the red curve adds τ₂.
#
# The first twist τ₁ is small and positive, the second τ₂ is large and negative.  Both are read off
# fifty curves and the multipliers at P\*, without any higher derivative of Φ. Step 10 shows why τ₁
# is so small.

# %% [markdown]
# ## 6. Continuation in f: pitchfork, flip, borders
#
# Now follow P\* as the friction f varies.

# %%
# !python -m cap.explore continuation --range 0.1 0.65 --out pictures/continuation.svg

# %% [markdown]
# ![The fixed points followed in f](pictures/continuation.svg)
#
# Above are the fixed points, below the traces of Φ' at them; full lines are elliptic orbits and
# sinks, broken lines the others. The blue pair, to which P\* belongs, begins at the diamond, a
# pitchfork of the red orbit, which is its own mirror image; at the left the pair loses its
# stability in a flip (a multiplier is -1), and at the right the red orbit has a fold. From one of
# the flips begins a branch of orbits of period 2T, in green: the period doubles.  Those orbits are
# stable until they flip, too.
#
# The pentagons are borders where the events of the orbit change, and Φ is not smooth. At the one
# near f = 0.348 the trace jumps: the least speed of the orbit vanishes there, and to its left the
# orbits of the pair stick once per period. (`python -m cap.explore orbit --f 0.34 --orbit 0.05
# 0.52` shows it.)

# %% [markdown]
# ## 7. All periodic orbits at F = 3
#
# With stronger forcing there are periodic orbits that turn and stick, and sinks among them.
# `inventory` starts Newton's method from many seeds, and keeps what it finds.

# %%
# !python -m cap.explore inventory --F 3 --out pictures/inventory.svg

# %% [markdown]
# ![The fixed points found at F = 3](pictures/inventory.svg)
#
# The circle is a sink, the two crosses are sinks that stick once (one multiplier is 0, the other
# is the trace), and the triangles are saddles of both kinds. All twenty-five have x > 0 at t = 0;
# by the mirror symmetry each has a partner, perhaps itself, that has x < 0 at t = T/2.
#
# "All" means all that the seeds led to; that nothing was missed is not proved.  But each orbit that
# was found can go to a prover like that of step 8, and its certificate to the checker of step 9:
# add `--prove`. All twenty-five are proved (`docs/theorems.md`).

# %% [markdown]
# ## 8. From a picture to a proof
#
# Choose your own friction, say f = 9/20.  The prover looks for an elliptic fixed point in floats;
# this is a guess, and needs no trust. Then it proves with enclosures what the theorem says.

# %%
# !python -m cap.prove elliptic --f 9/20 --digits 12 --out elliptic.json

# %% [markdown]
# How to read it:
#
# - `f = 9/20` is exact, and so is every parameter: 0.45 would mean the same.
# - The first sentence is existence and uniqueness: in that rectangle Φ has one and only one fixed
#   point.
# - Each pair of numbers `[a, b]` is an enclosure: the true number is at least a and at most b.
# - `least speed` is positive: the velocity never vanishes, so the map is analytic near P\*.
# - `trace` lies between -2 and 2: P\* is elliptic.
# - No resonance of order at most four: the distances of the rotation number to 0, 1/4, 1/3 and 1/2
#   are positive.
# - `Theta` is the angle by which Φ turns at P\*, positive from x to v; the rotation number is its
#   size over 2π.  `tau_1` says how the angle grows with the distance, counted with the same sign.
# - `tau_1` is not zero: the twist condition of Moser's theorem.
# - What follows from a theorem in the literature is *cited*, with each hypothesis and the numbers
#   that discharge it.
#
# So closed curves like those of the picture in step 2 do exist around this fixed point, as close to
# it as one likes. How far out they go, the theorem does not say. (For the paper's f = 2/5 leave out
# `--f`.)

# %% [markdown]
# ## 9. Do not trust the prover: check the certificate
#
# The file `elliptic.json` holds the statement and the numbers of the proof.  The checker is another
# program: it uses only the standard library of Python, has its own arithmetic, and computes the
# proof again from the certificate.

# %%
# !python -m cap.verify --explain elliptic.json

# %% [markdown]
# A checker that says yes to everything would print the same.  So tell it lies: in one copy change
# the last digit of the lower end of v, so that the certificate claims to know v exactly; in another
# copy change one digit of f.

# %%
import json
from pathlib import Path

text = Path("elliptic.json").read_text()
low, high = json.loads(text)["claims"]["v"]
print(f"v lies in [{low}, {high}]; now the first end becomes {high}")
Path("wrong-v.json").write_text(text.replace(f'"{low}"', f'"{high}"'))
Path("wrong-f.json").write_text(text.replace('"9/20"', '"7/20"'))

# %% tags=["raises-exception"]
# !python -m cap.verify wrong-v.json
# !python -m cap.verify wrong-f.json

# %% [markdown]
# Both are rejected.  In the second, the enclosures of the orbit at f = 7/20 do not fit the time
# windows of the certificate.

# %% [markdown]
# ## 10. A theorem for all f, and what there is for you
#
# The pair of step 6, above f = 0.348, is known in closed form, with one parameter δ:
# `cap.one_one.closed_form` has the formulas. Here they are evaluated in enclosures, without any
# search (ρ is Rω²/F):

# %%
from fractions import Fraction

from cap.one_one.closed_form import asymmetric
from cap.sets import interval

with interval.workprec(100):
    print("delta f            trace        least speed on each flight")
    for delta in ("0.1", "0.2", "0.3", "0.36", "0.4"):
        orbit = asymmetric(interval.ball(Fraction(delta)), rho=interval.ball(2))
        shown = (orbit.alpha, orbit.trace(), *orbit.slowest())
        print(f"{delta:5}", "".join(f"{q.str(6, radius=False):13}" for q in shown))

# %% [markdown]
# That is why one proof can treat a whole range of f.  Around the paper's f = 2/5:

# %%
# !python -m cap.prove branch --from 2/5 --to 40005/100000 --out branch.json

# %% [markdown]
# The twist vanishes at an f between 0.40002856 and 0.40002857, just above 2/5: this is why τ₁, at
# 2/5, was so small in step 5.  At every f of this range outside that tiny interval, and so at the
# paper's f = 2/5, both orbits are surrounded by invariant curves. (The trace is above -2 there, as
# the theorem asks: it grows with f, and at 2/5 the theorem in the README has -0.460….) Without
# `--from` and `--to` the command proves this for the whole branch, from the pitchfork down to the
# border near f = 0.348, but for four tiny intervals; that takes longer, and
# `certificates/branch.json` is the result.
#
# What else can you use?  First, the certified flow: give it a box of states, and any parameters.
# Here with restitution 9/10 and viscosity 1/20, for all states at distance at most 1/1000 from
# (0.1, 0.54) in x and in v:

# %%
from cap.errors import NotProved
from cap.flow.propagation import after_periods
from cap.parameters import Parameters

e, mu = Fraction("0.9"), Fraction("0.05")
lossy = Parameters(F=1, omega=1, f=Fraction("0.4"), l=-1, r=1, e=e, mu=mu)


def image(reach):
    """Return what is proved of all orbits from a square around (0.1, 0.54)."""
    x, v = (interval.around(Fraction(q), Fraction(reach)) for q in ("0.1", "0.54"))
    return after_periods(lossy, x, v, 2)


with interval.workprec(100):
    proved = image("1/1000")
    for event in proved.events:
        print(event.word, "at t in [{}, {}]".format(*interval.outward(event.time, 3)))
    for name, enclosure in zip("xv", proved.state, strict=True):
        print(f"then {name} in", "[{}, {}]".format(*interval.outward(enclosure, 3)))
    try:
        image("1/5")
    except NotProved as error:
        print("NotProved:", error)

# %% [markdown]
# Every orbit from the smaller box has these events, in this order, at such times, and no other. The
# larger box is too large: not all its orbits may have the same events, and the flow says so. *Not
# proved* never means false.
#
# Second, an impact system of your own.  Enclosures, jets (truncated Taylor series) and Krawczyk's
# operator know nothing of friction.  The example is a ball that bounces on a vibrating table, with
# restitution 9/10, in the approximation of high bounces: φ' = φ + w, w' = (9/10) w + cos φ', with φ
# mod 2π.  Write the map once; jets over enclosures give its derivative; `contract` proves.

# %%
from cap.maps.krawczyk import Preconditioner, contract
from cap.sets import matrix
from cap.sets.jet import Jet


def table(phi, w):
    """Return the state after the next bounce, one turn of the table later."""
    landing = phi + w - 2 * interval.pi()
    _, cos = landing.sin_cos()
    return landing, w * 9 / 10 + cos


def slope(box):
    """Return enclosures of the derivatives of the map, for all states of a box."""
    return tuple((jet[1, 0], jet[0, 1]) for jet in table(*Jet.variables(box, order=1)))


with interval.workprec(100):
    guess = Fraction("0.89"), Fraction("6.28")
    point = tuple(interval.ball(q) for q in guess)
    inverse = matrix.inverse(matrix.minus_identity(slope(point)))
    inverse = tuple(tuple(interval.midpoint(q) for q in row) for row in inverse)
    for reach in (Fraction(1, 50), Fraction(1, 1000), Fraction(1, 10**6), Fraction(1, 10**9)):
        hint = Preconditioner(guess, inverse)
        box = hint.box((reach, reach))
        fixed = contract(hint, table(*hint.point), slope(box), box)
        guess = tuple(interval.midpoint(q) for q in fixed)
    print("phi in [{}, {}]".format(*interval.outward(fixed[0], 15)))
    print("w   in [{}, {}]".format(*interval.outward(fixed[1], 15)))
    print("arccos(pi/5) and 2 pi:", (interval.pi() / 5).acos().str(16), (2 * interval.pi()).str(16))

# %% [markdown]
# Each call of `contract` proves that the map has exactly one fixed point in its box, and returns a
# smaller box that contains it; if it cannot, it raises `NotProved`. Here the answer is known (w =
# 2π, cos φ = π/5), and lies where it must.

# %% [markdown]
# ## 11. Two masses: an island that does not enclose, and what attracts the rest
#
# Put two masses between the walls, m₁ = 1 and m₂ = 9/10; the forcing and the friction act on each
# of them, and they collide elastically.  The state has four numbers now, (x₁, x₂, v₁, v₂).  The
# friction is f = 91/200.

# %%
# !python -m cap.explore orbit --masses 1,9/10 --f 91/200 --out pictures/two.svg
# !python -m cap.explore portrait --masses 1,9/10 --f 91/200 --dpi 120 --out pictures/masses.png

# %% [markdown]
# ![Positions and velocities of two masses](pictures/two.svg)
#
# Without a starting state the orbit is one that is continued from two equal masses (these would
# pass through each other unchanged): each mass hits its wall twice per period, there are four
# collisions, and no velocity vanishes.
#
# ![Mixed dynamics of two masses, projected](pictures/masses.png)
#
# The portrait shows the state at t = 0 mod T in two projections, the first mass on the left and the
# second one on the right; below are the surroundings of the star, the orbit above. Half of the
# orbits begin near it: no mass stopped on any of them.  The others begin anywhere, and the red dots
# are the last quarter of each: the rows of dots are masses that slide to and fro and touch nothing
# (`prove sliding`), the single dots an orbit of period 3T.  So friction attracts most orbits, and
# near the star there is none of its effects: *mixed dynamics*.
#
# Now prove it, near the star:

# %%
# !python -m cap.prove particles --masses 1,9/10 --f 91/200 --digits 6 --out two.json
# !python -m cap.verify --explain two.json

# %% [markdown]
# `Phi'` is the 4 x 4 derivative of Φ, and B the twist, a matrix now: it says how the two angles
# grow with both amplitudes.  All multipliers lie on the unit circle, and det B is not 0; so by KAM
# theory there are invariant tori around the star, and on their orbits no mass ever stops. One thing
# is weaker than for one mass: closed curves enclose a region in the plane, but tori of dimension 2
# enclose nothing in dimension 4.  Orbits between the tori may drift away, and no island is claimed.
#
# From here: `python -m cap.explore --help` and `python -m cap.prove --list` show what there is,
# `docs/theorems.md` says what has been proved, and `proofs/` has one file per theorem.
