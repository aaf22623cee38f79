"""Section 2.4: the stroboscopic map and the never-stopping set."""

from itertools import product

from cap.audit import labels
from cap.audit.means.balls import pair
from cap.audit.means.need import need
from cap.audit.means.stored import at_the_paper, stored
from cap.audit.steps import Words

STATES = range(4)


def three_types() -> None:
    title = labels.stored().place("thm:symmetric").title
    need("non-sticking" in title, "Theorem 4.2 is not about non-sticking orbits")


def forward_invariance() -> None:
    need(all(_invariant(image, good) for image, good in _all_maps()), "a map refutes it")


def _all_maps() -> "product[tuple[tuple[int, ...], tuple[bool, ...]]]":
    maps = product(STATES, repeat=len(STATES))
    subsets = product((False, True), repeat=len(STATES))
    return product(maps, subsets)


def _invariant(image: tuple[int, ...], good: tuple[bool, ...]) -> bool:
    """Return whether the set of the definition is invariant, and the largest such subset."""
    kept = {z for z in STATES if all(good[w] for w in _orbit(z, image))}
    largest = {z for z in STATES if good[z]}
    while any(image[z] not in largest for z in largest):
        largest = {z for z in largest if image[z] in largest}
    return all(image[z] in kept for z in kept) and kept == largest


def _orbit(z: int, image: tuple[int, ...]) -> set[int]:
    seen = set[int]()
    while z not in seen:
        seen.add(z)
        z = image[z]
    return seen


def never_stopping_orbits_exist() -> Words:
    claims = stored("elliptic.json").claims
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    distances = claims["resonance_distances"].values()
    need(all(each.lower > 0 for each in distances), "a resonance is possible")
    twist = claims["twist"]
    need(twist.lower > 0 or twist.upper < 0, "the twist may vanish")
    disk = stored("island.json")
    need(at_the_paper(disk), "the invariant disk is at other parameters")
    area = disk.claims["area"]
    need(area.lower > 0, "the disk may have no area")
    return {"area": pair(area, 8)}
