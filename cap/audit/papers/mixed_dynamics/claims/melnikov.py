"""Section 6: the Melnikov function, its integrals, and what is concluded."""

from fractions import Fraction

from cap.audit.means.balls import between, precisely
from cap.audit.means.need import need
from cap.audit.papers.mixed_dynamics.means.melnikov import (
    SECH,
    SECH_SQUARED_COS,
    SECH_TANH_COS,
    SECH_TANH_SIN,
)
from cap.audit.steps import Words
from cap.sets import interval
from cap.sets.interval import Ball

FREQUENCIES = Fraction(1, 2), Fraction(1), Fraction(3)


def sine_transform() -> Words:
    shown = []
    with precisely():
        for q in FREQUENCIES:
            xi = interval.ball(q)
            value, of_square = SECH_TANH_SIN.by_quadrature(xi), SECH_SQUARED_COS.closed(xi)
            need(value.overlaps(SECH_TANH_SIN.closed(xi)), "it is not πξ/cosh(πξ/2)")
            need(not value.overlaps(of_square), "it may be πξ/sinh(πξ/2)")
            need(SECH_SQUARED_COS.by_quadrature(xi).overlaps(of_square), "nor that of sech²")
            shown.append(between(value, 8))
    return {"shown": ", ".join(shown)}


def cosine_transform() -> Words:
    shown = []
    with precisely():
        for q in FREQUENCIES:
            xi = interval.ball(q)
            cosine, as_stated = SECH_TANH_COS.by_quadrature(xi), SECH_SQUARED_COS.closed(xi)
            need(cosine.contains(0), "the integral is not 0")
            need(not cosine.overlaps(as_stated), "it may be as stated")
            shown.append(between(as_stated, 4))
    return {"shown": ", ".join(shown)}


def vanishing_integral() -> Words:
    with precisely():
        cosine, sine = (each.by_quadrature(Ball(1)) for each in (SECH_TANH_COS, SECH_TANH_SIN))
        need(cosine.contains(0), "the cosine integral does not vanish")
        need(sine > 1, "the sine integral may vanish")
    return {"words": sine}


def integral_of_sech() -> Words:
    with precisely():
        value = SECH.by_quadrature(Ball(1))
        need(value.overlaps(SECH.closed(Ball(1))), "the integral of sech is not π")
    return {"words": value}
