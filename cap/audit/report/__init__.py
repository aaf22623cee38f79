"""The report: the same findings as text, Markdown, a page, LaTeX, and data."""
