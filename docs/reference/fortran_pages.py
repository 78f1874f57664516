# SPDX-License-Identifier: Apache-2.0
# fortran_pages.py FOLDER BOOTSTRAP: makes FORD's pages in the folder self-contained. FORD's pages load Bootstrap and MathJax from
# a server. Here the pages get the distribution's Bootstrap, from the folder BOOTSTRAP. The pages have no formulas, so they need
# no MathJax.
import pathlib
import re
import shutil
import sys

folder, bootstrap = (pathlib.Path(argument) for argument in sys.argv[1:])
files = {"css": "bootstrap.min.css", "js": "bootstrap.bundle.min.js"}
for part, name in files.items():
    if not (bootstrap / part / name).is_file():
        sys.exit(f"fortran_pages.py: there is no {bootstrap / part / name}; Debian's package libjs-bootstrap5 has it")
    shutil.copyfile(bootstrap / part / name, folder / part / name)

REMOTE = r'"https://[^"]*/'
n_pages = 0
for page in sorted(folder.rglob("*.html")):
    text = page.read_text(encoding="utf-8")
    root = "../" * (len(page.relative_to(folder).parts) - 1) or "./"
    text, n_css = re.subn(rf"<link href={REMOTE}{re.escape(files['css'])}\"[^>]*>",
                          f'<link href="{root}css/{files["css"]}" rel="stylesheet">', text)
    text, n_js = re.subn(rf"<script src={REMOTE}{re.escape(files['js'])}\"[^>]*>",
                         f'<script src="{root}js/{files["js"]}">', text)
    text = re.sub(r"<!-- MathJax -->\s*", "", text)
    text = re.sub(r'<script type="text/x-mathjax-config">.*?</script>\s*', "", text, flags=re.DOTALL)
    text = re.sub(rf"<script src={REMOTE}MathJax\.js[^>]*></script>\s*", "", text)
    text = re.sub(r'#moduleprocedure-[^"]*"', '"', text)  # places to which FORD links without making them
    if (n_css, n_js) != (1, 1):
        sys.exit(f"fortran_pages.py: {page} does not ask for Bootstrap as FORD's pages did: this script is out of date")
    page.write_text(text, encoding="utf-8")
    n_pages += 1
if n_pages == 0:
    sys.exit(f"fortran_pages.py: no pages in {folder}")
print(n_pages, "pages")
