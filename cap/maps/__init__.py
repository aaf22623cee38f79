"""The map over one period: Krawczyk, fixed points, normal form, twist, stability, basins,
families."""
