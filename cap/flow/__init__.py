"""The hybrid flow: the mechanics once for any scalar, certified events, sets over many periods."""
