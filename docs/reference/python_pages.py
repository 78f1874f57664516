# SPDX-License-Identifier: Apache-2.0
# python_pages.py FOLDER: writes the reference of the installed Python package riis to the folder, by pdoc. Ends with an error if
# a public name lacks a text. The text of an exception, an enumeration or a record describes its members as well.
import inspect
import pathlib
import re
import sys
import warnings

import pdoc
import riis


def undocumented():
    """Yields the public names without a text, such as riis.Valve.copy."""
    for name in riis.__all__:
        thing = getattr(riis, name)
        if not callable(thing) and not inspect.ismodule(thing):
            continue  # a constant, whose text is in the stub
        if not (inspect.getdoc(thing) or "").strip():
            yield f"riis.{name}"
        if not inspect.isclass(thing) or issubclass(thing, Exception):
            continue
        for member, value in vars(thing).items():
            documented = callable(value) or isinstance(value, (property, classmethod, staticmethod))
            if not member.startswith("_") and documented and not (inspect.getdoc(getattr(thing, member)) or "").strip():
                yield f"riis.{name}.{member}"


missing = sorted(undocumented())
if missing:
    sys.exit("python_pages.py: without a text: " + ", ".join(missing))
# Some types have names only for type checkers. pdoc shows these names as they are written, and warns.
warnings.filterwarnings("ignore", message="Error parsing type annotation")
pdoc.render.configure(docformat="markdown", show_source=False, search=False, footer_text=f"riis {riis.version_string()}")
folder = pathlib.Path(sys.argv[1])
pdoc.pdoc("riis", output_directory=folder)
for page in folder.rglob("*.html"):  # links to private base classes, which have no pages
    text = page.read_text(encoding="utf-8")
    page.write_text(re.sub(r'<a href="[^"]*#_[^"]*">(.*?)</a>', r"\1", text, flags=re.DOTALL), encoding="utf-8")
print(len(riis.__all__), "names")
