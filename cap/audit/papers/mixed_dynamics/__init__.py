"""A. Thiam, Mixed Global Dynamics of the Forced Vibro-Impact Oscillator with Coulomb Friction."""
