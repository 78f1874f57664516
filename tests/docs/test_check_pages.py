# SPDX-License-Identifier: Apache-2.0
"""Tests which faults in invented files check_pages.py and check_links.py refuse."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
GOOD = {
    "index.html": '<html><head><link href="css/a.css" rel="stylesheet"><script src="a.js"></script></head><body>'
                  '<a href="more/b.html#there">b</a> <a href="https://example.org/">web</a> <img src="a.png"></body></html>',
    "more/b.html": '<p id="there"><a href="../index.html">a</a> <a href="#there">here</a></p>',
    "css/a.css": '@import "b.css"; p { background: url("../a.png") } /* url(none.png) */',
    "css/b.css": "", "a.js": "", "a.png": "",
}


class Checks(unittest.TestCase):
    def run_on(self, script, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, content in files.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(content, encoding="utf-8")
            return subprocess.run([sys.executable, "-B", os.path.join(HERE, script), folder], capture_output=True, text=True,
                                  check=False)

    def refuses(self, script, good, name, found, replacement, text):
        self.assertIn(found, good[name])
        done = self.run_on(script, {**good, name: good[name].replace(found, replacement)})
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(text, done.stderr)

    def test_good_pages(self):
        self.assertEqual(self.run_on("check_pages.py", GOOD).returncode, 0)

    def test_pages(self):
        for name, found, replacement, text in [
            ("index.html", "css/a.css", "https://example.org/a.css", "loads https://example.org/a.css from a server"),
            ("index.html", 'src="a.js"', 'src="//example.org/a.js"', "loads //example.org/a.js from a server"),
            ("index.html", "a.png", "http://example.org/a.png", "loads http://example.org/a.png from a server"),
            ("css/a.css", "b.css", "https://example.org/b.css", "css/a.css: loads https://example.org/b.css from a server"),
            ("css/a.css", "../a.png", "//example.org/a.woff", "loads //example.org/a.woff from a server"),
            ("index.html", "css/a.css", "css/c.css", "css/c.css is not in the folder"),
            ("index.html", "a.png", "c.png", "c.png is not in the folder"),
            ("css/a.css", "../a.png", "a.png", "css/a.css: a.png is not in the folder"),
            ("index.html", "more/b.html#there", "b.html", "b.html is not in the folder"),
            ("index.html", "b.html#there", "b.html#nowhere", "more/b.html#nowhere: the page has no such place"),
            ("more/b.html", "#there", "#nowhere", "#nowhere: the page has no such place"),
            ("more/b.html", "../index.html", "../../index.html", "../../index.html is not in the folder"),
            ("more/b.html", "<p ", "<style>p { background: url(http://example.org/a.png) }</style><p ", "from a server"),
        ]:
            with self.subTest(replacement):
                self.refuses("check_pages.py", GOOD, name, found, replacement, text)

    def test_links(self):
        good = {"README.md": "# A\n[b](docs/b.md#two-words) [a](#a) [web](https://example.org) `[c](c.md)`\n",
                "docs/b.md": "## Two words\n```sh\n[d](d.md)\n```\n![a](a.png) `src/x/*/NAME.cpp` `bin/a`\n", "docs/a.png": "",
                "docs/walks.md": "| `part/a.cpp` | it works |\n",
                "debian/tests/t": 'cc src/x/part/a.cpp -o "$work/b" && diff src/x/$name.txt "$work/src/c"\n',
                "src/x/part/a.cpp": '// The proof is in docs/b.md, "Two\n// words".',
                "docs/theory/t.md": "# T\n[b](../b.md) $x$ `$HOME`\n```math\n$\n```\nHere is `a.cpp`.\n",
                "include/y.h": "/* docs/theory/t.md has\n * the rest. */", "CHANGELOG.md": 'docs/gone.md, "Gone"\n',
                "examples/n.ipynb": '["see docs/b.md,\\n",\n  "\\"Two words\\""]'}
        self.assertEqual(self.run_on("check_links.py", good).stderr, "")
        for name, found, replacement, text in [
            ("README.md", "docs/b.md", "b.md", "README.md: b.md#two-words: there is no such file"),
            ("README.md", "#two-words", "#three", "docs/b.md#three: there is no such heading"),
            ("docs/b.md", "a.png", "b.png", "docs/b.md: b.png: there is no such file"),
            ("docs/walks.md", "a.cpp", "z.cpp", "docs/walks.md: part/z.cpp: there is no such file"),
            ("docs/b.md", "src/x/*", "src/y/*", "docs/b.md: src/y/*/NAME.cpp: there is no such file"),
            ("docs/theory/t.md", "`a.cpp`", "`z.cpp`", "docs/theory/t.md: z.cpp: there is no such file"),
            ("docs/theory/t.md", "../b.md", "b.md", "docs/theory/t.md: b.md: there is no such file"),
            ("docs/theory/t.md", "$x$", "$x", "docs/theory/t.md:2: a formula must begin and end on one line"),
            ("docs/theory/t.md", "$x$", "$$x$$", "docs/theory/t.md:2: a formula must begin and end on one line"),
            ("docs/theory/t.md", "$x$", "word " * 4000, "docs/theory/t.md: 4010 words; at most 4000"),
            ("src/x/part/a.cpp", "docs/b.md", "docs/c.md", "src/x/part/a.cpp: docs/c.md: there is no such file"),
            ("src/x/part/a.cpp", "words", "sentences", 'docs/b.md, "Two sentences": there is no such heading'),
            ("src/x/part/a.cpp", '"Two\n// words"', "section 8", "docs/b.md, section 8: name the heading"),
            ("include/y.h", "t.md", "u.md", "include/y.h: docs/theory/u.md: there is no such file"),
            ("debian/tests/t", "part/a.cpp", "part/z.cpp", "debian/tests/t: src/x/part/z.cpp: there is no such file"),
            ("examples/n.ipynb", "Two", "Three", 'examples/n.ipynb: docs/b.md, "Three words": there is no such heading'),
        ]:
            with self.subTest(text):
                self.refuses("check_links.py", good, name, found, replacement, text)


unittest.main()
