"""Sentences here and there that a reading of the whole text stops at."""

from cap.audit import labels
from cap.audit.means.algebra import symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.steps import Words

READ = "The text."


def base_of_the_region() -> Words:
    F, R, w = symbols("F R omega")
    f_sc, f_imp = 4 * (2 * F + R * w**2 - F * sp.pi) / sp.pi**2, 2 * F / sp.pi
    largest = sp.solve(f_sc - f_imp, R)
    need(len(largest) == 1 and bool(largest[0].is_positive), "f_sc < f_imp for all R")
    return {"largest": sp.sstr(sp.simplify(largest[0]))}


def bibliography() -> Words:
    own = labels.stored()
    need(own.cited > 0 and own.references == 0, "there is a bibliography")
    return {"cited": own.cited}


def pictures() -> Words:
    own = labels.stored()
    need(own.pictures > 0, "all pictures have files")
    return {"pictures": own.pictures}
