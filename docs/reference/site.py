# SPDX-License-Identifier: Apache-2.0
"""site.py FOLDER: makes one site from the pages of Doxygen, FORD and pdoc in the folder.

The pages of FORD and pdoc, in fortran/ and python/, get a bar that leads to all parts. search.html searches all parts. It loads
an index, site_index.js, so that it works without a server. An entry of the index is a part of a page that begins with a heading
or a documented name: its title, its page's title, its address and its words.
"""
import html
import html.parser
import json
import pathlib
import re
import sys

PARTS = [("riis", "index.html"), ("C", "riis_8h.html"), ("C++", "riis_8hpp.html"), ("Fortran", "fortran/index.html"),
         ("Python", "python/riis.html"), ("Pages", "pages.html"), ("Figures", "figures.html"), ("Search", "search.html")]
BAR = """<div class="riis-bar" style="padding: 6px 12px; background: #364d7c; font: 15px sans-serif">
%s</div>"""
LINK = '<a style="color: white; margin-right: 1.1em; display: inline-block; text-decoration: none" href="%s">%s</a>'
SILENT = {"script", "style", "nav", "head", "math", "form"}
SILENT_PLACES = {"side-nav", "nav-path", "main-nav", "MSearchSelectWindow"}
LISTS = re.compile(r"^(globals|functions|namespacemembers)|-members\.html$|^dir_")  # pages that only repeat names
VOID = {"area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "track", "wbr"}


class Entries(html.parser.HTMLParser):
    """The parts of a page. A part begins at a heading, or at a definition that pdoc puts into a section with a name."""

    def __init__(self, text):
        super().__init__()
        self.title, self.place = "", ""
        self.parts = [["", "", []]]  # each with its place, its heading and its text
        self.silent, self.heading, self.in_title = [], None, False  # silent: the open tags of the kind that began a silent part
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag in VOID:
            return
        attributes = dict(attributes)
        self.in_title = tag == "title"
        if self.silent:
            self.silent += [tag] * (tag == self.silent[0])
            return
        if tag in SILENT or attributes.get("class") == "riis-bar" or attributes.get("id") in SILENT_PLACES:
            self.silent.append(tag)
            return
        place = attributes.get("id") or (attributes.get("name") if tag == "a" else None)
        self.place = place or self.place
        # pdoc describes a class or a function in a section, and a member in a division of the class "classattr".
        member = place and (tag == "section" or attributes.get("class") == "classattr")
        if tag in ("h1", "h2", "h3", "h4") or member:
            self.heading = None if member else tag
            self.parts.append([place or self.place, "", []])

    def handle_endtag(self, tag):
        if tag == "title":
            self.in_title = False
        if self.silent:
            if tag == self.silent[0]:
                self.silent.pop()
        elif tag == self.heading:
            self.heading = None

    def handle_data(self, data):
        if self.in_title:
            self.title += data
        elif not self.silent:
            part = self.parts[-1]
            if self.heading:
                part[1] += data
            part[2].append(data)


def entries_of(folder, page):
    name = page.relative_to(folder).as_posix()
    parsed = Entries(page.read_text(encoding="utf-8"))
    title = re.sub(r"^riis: |( – | &ndash; ).*$", "", parsed.title.strip()).replace(" API documentation", " in Python")
    for place, heading, words in parsed.parts:
        text = " ".join(" ".join(words).split())
        heading = " ".join(heading.replace("\u25c6", "").split()).removesuffix("()") or place.split(".")[-1] or title
        if len(text) > 3:
            yield [heading[:80], title, name + (f"#{place}" if place else ""), text[:4000]]


SEARCH = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>riis: search</title><style>
body { margin: 0; font: 16px/1.5 sans-serif; color: #222 }
main { max-width: 50em; margin: 1em auto; padding: 0 12px }
input { width: 100%%; font: inherit; padding: .4em; box-sizing: border-box }
li { margin: .6em 0; overflow-wrap: anywhere } small { color: #555 } mark { background: #ffe9a8 }
</style></head><body>
%s
<main><h1>Search</h1>
<p><label for="words">Words, all of which a result must have, in C, C++, Fortran, Python and the pages:</label></p>
<p><input id="words" type="search" autofocus></p><p id="count"></p><ol id="results"></ol></main>
<script src="site_index.js"></script><script>
const input = document.getElementById("words"), list = document.getElementById("results");
const lower = site_index.map(entry => entry.slice(0, 2).concat(entry[3]).map(text => text.toLowerCase()));
function weight(texts, words) {
  let sum = 0;
  for (const word of words) {
    if (texts[0] === word) sum += 40;
    else if (texts[0].includes(word)) sum += 12;
    else if (texts[1].includes(word)) sum += 4;
    else if (texts[2].includes(word)) sum += 1;
    else return 0;
  }
  return sum;
}
function add(parent, tag, text) {
  const element = document.createElement(tag);
  element.textContent = text;
  parent.append(element);
  return element;
}
function search() {
  const words = input.value.toLowerCase().split(/\\s+/).filter(word => word);
  const found = words.length ? site_index.map((entry, i) => [weight(lower[i], words), i]).filter(pair => pair[0]) : [];
  found.sort((a, b) => b[0] - a[0] || a[1] - b[1]);
  document.getElementById("count").textContent = words.length ? found.length + " results" : "";
  list.replaceChildren();
  for (const [, i] of found.slice(0, 40)) {
    const [heading, title, address, text] = site_index[i], item = add(list, "li", "");
    const at = Math.max(0, lower[i][2].indexOf(words[0]) - 60);
    add(item, "a", heading).href = address;
    add(item, "span", "  " + title);
    item.append(document.createElement("br"));
    add(item, "small", text.slice(at, at + 200));
  }
  history.replaceState(null, "", "?" + new URLSearchParams({ words: input.value }));
}
input.value = new URLSearchParams(location.search).get("words") || "";
input.addEventListener("input", search);
search();
</script></body></html>
"""


def bar(depth):
    return BAR % "".join(LINK % ("../" * depth + address, html.escape(name)) + "\n" for name, address in PARTS)


def main(folder):
    entries = []
    for page in sorted(folder.rglob("*.html")):
        depth = len(page.relative_to(folder).parts) - 1
        if page.name == "search.html" and not depth:
            continue
        text = page.read_text(encoding="utf-8")
        if 'http-equiv="refresh"' in text:
            continue  # only leads to another page
        if depth and 'class="riis-bar"' not in text:
            # pdoc lays out its body in columns, so the bar becomes the head of the main column.
            start = r'(<main class="pdoc">)' if '<main class="pdoc">' in text else r"(<body[^>]*>)"
            text, n = re.subn(start, lambda found, depth=depth: found[1] + bar(depth), text, count=1)
            if n != 1:
                sys.exit(f"site.py: {page} has no body")
            page.write_text(text, encoding="utf-8")
        if page.parent.name != "search" and not LISTS.search(page.name):
            entries += entries_of(folder, page)
    for part in ("fortran/", "python/", "riis_8h"):
        if not any(entry[2].startswith(part) for entry in entries):
            sys.exit(f"site.py: nothing of {part} is in the index")
    index = json.dumps(entries, ensure_ascii=False, separators=(",", ":"))
    (folder / "site_index.js").write_text(f"const site_index = {index};\n", encoding="utf-8")
    (folder / "search.html").write_text(SEARCH % bar(0), encoding="utf-8")
    print(len(entries), "entries")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: site.py FOLDER")
    main(pathlib.Path(sys.argv[1]))
