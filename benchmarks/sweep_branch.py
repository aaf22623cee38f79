"""The theorem branch for walls at many distances R, F = omega = 1: proved, with how many cells?

    python benchmarks/sweep_branch.py                  R = 0.71, 0.8, 0.9, .. 2.9
    python benchmarks/sweep_branch.py 0.705 2.93       at these R

One line for each; exit status 1 if one is not proved.  The pair is genuine at its birth for
R > 0.70406.., and is born for R < (pi^2 - 4)/2 = 2.9348..
"""

import sys
import time
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction

from cap.errors import BadInput, NotProved
from cap.maps.fixed_point import Start
from cap.parameters import Parameters
from cap.proofs import theorems
from cap.proofs.fixed_point import Setting

STEPS = ["0.71", *(str(Fraction(n, 10)) for n in range(8, 30))]


def attempted(word):
    """Return R, whether the checker accepts the certificate, and the line about it."""
    R, began = Fraction(word), time.monotonic()
    p = Parameters(Fraction(1), Fraction(1), Fraction(1, 2), Fraction(-1), R - 1)
    ask = Setting(p, Start(0.0, 0.0, ()), 30)
    try:
        proved = theorems.accepted(theorems.THEOREMS["branch"], ask)
    except (NotProved, BadInput) as failure:
        return False, f"{float(R):<8g} not proved: {failure}"
    claims = proved["claims"]
    end = claims["f_end"] if claims["f_end"] == "none" else claims["f_end"][0][:12]
    seconds = time.monotonic() - began
    range_of_f = f"f from {end} to {claims['f_start'][0][:12]}"
    return True, f"{float(R):<8g} {len(claims['cells']):>5} cells  {seconds:5.1f} s  {range_of_f}"


def main():
    """Print the table; return the exit status."""
    status = 0
    with ProcessPoolExecutor() as executor:
        for accepted, line in executor.map(attempted, sys.argv[1:] or STEPS):
            print(line, flush=True)
            status |= not accepted
    return status


if __name__ == "__main__":
    sys.exit(main())
