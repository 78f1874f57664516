# SPDX-License-Identifier: Apache-2.0
"""check_pages.py FOLDER: the HTML pages in the folder must not need anything outside it.

Everything that a page loads (style sheets, scripts, pictures, fonts) must be a file in the folder, never on a server. Links
to other pages must lead to a file in the folder and to an existing place in it. Links to web sites are not followed.
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

LOADED = {("link", "href"), ("script", "src"), ("img", "src"), ("img", "srcset"), ("iframe", "src"), ("object", "data"),
          ("embed", "src"), ("source", "src"), ("video", "src"), ("audio", "src"), ("image", "href"), ("use", "href")}
REMOTE = re.compile(r"(?:[a-z][a-z0-9+.-]*:)?//", re.IGNORECASE)
OTHER_SCHEME = re.compile(r"[a-z][a-z0-9+.-]*:", re.IGNORECASE)  # mailto:, javascript:, data:


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.loads, self.links, self.places, self.in_style = [], [], set(), False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if value is None:
                continue
            if name == "id" or (tag == "a" and name == "name"):
                self.places.add(value)
            elif (tag, name) in LOADED:
                self.loads.append(value)
            elif tag in ("a", "area") and name == "href":
                self.links.append(value)
            elif name == "style":
                self.loads += loads_of_css(value)
        self.in_style = tag == "style"

    handle_startendtag = handle_starttag

    def handle_endtag(self, tag):
        self.in_style = False

    def handle_data(self, data):
        if self.in_style:
            self.loads += loads_of_css(data)


def loads_of_css(text):
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    urls = re.findall(r"""url\(\s*(?:"([^"]*)"|'([^']*)'|([^)"'\s]*))\s*\)""", text)
    imports = re.findall(r"""@import\s+["']([^"']*)["']""", text)
    return ["".join(url) for url in urls] + imports


class Folder:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.pages = {path.resolve(): Page(path.read_text(encoding="utf-8")) for path in sorted(self.folder.rglob("*.html"))}
        self.problems = []

    def say(self, path, problem):
        self.problems.append(f"{path.relative_to(self.folder)}: {problem}")

    def check_local(self, path, url):
        """Returns the file to which a relative link points. If this file does not exist, reports a problem and returns None."""
        target = urllib.parse.unquote(url.split("#")[0].split("?")[0])
        file = (path.parent / target).resolve() if target else path.resolve()
        if file.is_relative_to(self.folder.resolve()) and file.exists():
            return file
        self.say(path, f"{url} is not in the folder")
        return None

    def check_loads(self, path, urls):
        for url in urls:
            if REMOTE.match(url):
                self.say(path, f"loads {url} from a server")
            elif not OTHER_SCHEME.match(url) and not url.startswith("#"):
                self.check_local(path, url)

    def check_links(self, path, urls):
        for url in urls:
            if REMOTE.match(url) or OTHER_SCHEME.match(url):
                continue
            file = self.check_local(path, url)
            place = url.partition("#")[2]
            if file in self.pages and place and not {place, urllib.parse.unquote(place)} & self.pages[file].places:
                self.say(path, f"{url}: the page has no such place")

    def check(self):
        for file, page in self.pages.items():
            path = self.folder / file.relative_to(self.folder.resolve())
            self.check_loads(path, page.loads)
            self.check_links(path, page.links)
        for path in sorted(self.folder.rglob("*.css")):
            self.check_loads(path, loads_of_css(path.read_text(encoding="utf-8")))
        return self.problems


if __name__ == "__main__":
    folder = Folder(sys.argv[1])
    if not folder.pages:
        sys.exit(f"no pages in {sys.argv[1]}")
    problems = list(dict.fromkeys(folder.check()))
    if problems:
        sys.exit("\n".join(problems[:40]) + f"\n{len(problems)} problems")
    print(len(folder.pages), "pages")
