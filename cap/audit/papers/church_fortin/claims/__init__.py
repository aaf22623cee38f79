"""The claims on the tables, and what decides them."""
