"""Make the API pages from the docstrings: ``python docs/api.py FOLDER``; a warning is an error."""

import argparse
import pkgutil
import warnings
from pathlib import Path

import matplotlib.font_manager  # noqa: F401 (asks for the fonts once, which pdoc forbids)
import pdoc

import cap

# pdoc has no names for the constructor of a record whose annotations are strings, also inherited
OF_RECORDS = r"Error parsing type annotation (ForwardRef\(.*\)|[^()]+) for cap\.[\w.]+\.__init__"

# nor where a typed dictionary has a key from
OF_KEYWORDS = r"Cannot determine where cap\.keywords\.\w+\.\w+ is taken from"


def main(folder: Path) -> None:
    """Write a page for each module of `cap`, and the index, to a folder."""
    warnings.simplefilter("error")
    warnings.filterwarnings("ignore", OF_RECORDS)
    warnings.filterwarnings("ignore", OF_KEYWORDS)
    for name in cap.__all__:  # what is loaded late is documented as well
        setattr(cap, name, getattr(cap, name))
    modules = [module.name for module in pkgutil.iter_modules(cap.__path__, "cap.")]
    rooms = [name for name in modules if name.removeprefix("cap.") not in cap.__all__]
    pdoc.render.configure(
        docformat="markdown", show_source=False, footer_text=f"cap {cap.__version__}"
    )
    pdoc.pdoc("cap", *rooms, output_directory=folder)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("folder", type=Path)
    main(parser.parse_args().folder)
