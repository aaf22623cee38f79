"""Launches from wall to wall that go on in vain: the area that `conservative` is about."""
