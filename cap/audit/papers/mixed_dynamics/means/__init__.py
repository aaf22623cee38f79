"""How claims of this paper are decided beside `cap.audit.means`: orbits, integrals, an equation."""
