"""The formulas of `cap.flow.flight` for compiled code."""

from cap.flow import flight
from cap.sets.compiled import kernel

place, velocity = kernel(flight.place), kernel(flight.velocity)
