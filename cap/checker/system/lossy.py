"""A mass between walls that may lose speed: all its parameters, and what it is in words."""

from __future__ import annotations

from cap.checker.kernel.reading import number
from cap.checker.system.walls import Parameters, Shapes

WITH_LOSSES: Shapes = dict.fromkeys(Parameters._fields, number)
SYSTEM = (
    "x'' = F cos(omega t) - f sgn x' - mu x' with F = {F}, omega = {omega}, f = {f}, mu = {mu} and "
    "walls at l = {l} and r = {r}, where v becomes -e v with e = {e}: "
)
