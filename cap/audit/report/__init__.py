"""The report: what it shows, and templates of text, Markdown, a page, LaTeX; and data."""
