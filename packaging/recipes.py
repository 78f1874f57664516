# SPDX-License-Identifier: Apache-2.0
"""recipes.py ARCHIVE URL FOLDER: writes the recipes for conda and Spack of a released archive into the folder.

ARCHIVE  the file that ./run dist made, whose name ends in -VERSION.tar.gz or -VERSION.tar.xz
URL      the address at which this file is published
FOLDER   gets conda/recipe.yaml, for conda-forge or another channel, and spack/riis/package.py, for a repository of Spack

The recipes of this folder have places for the address and for the checksum, because no archive can contain its own checksum.
"""
import hashlib
import pathlib
import re
import sys
import urllib.parse

HERE = pathlib.Path(__file__).resolve().parent
RECIPES = {"conda/recipe.yaml": "conda/recipe.yaml", "spack/package.py": "spack/riis/package.py"}


def fail(text):
    raise SystemExit(f"recipes.py: {text}")


def main(archive, url, folder):
    found = re.fullmatch(r"riis-([0-9]+\.[0-9]+\.[0-9]+)\.tar\.(gz|xz)", archive.name)
    if not found:
        fail(f"{archive.name} is not the name of a release's archive, riis-VERSION.tar.gz or riis-VERSION.tar.xz")
    address = urllib.parse.urlsplit(url)
    if address.scheme != "https" or not address.path.endswith("/" + archive.name):
        fail(f"{url} is not an address https://.../{archive.name}")
    places = {"URL": url, "SHA256": hashlib.sha256(archive.read_bytes()).hexdigest(),
              "HOMEPAGE": f"https://{address.netloc}" + "/".join(address.path.split("/")[:3])}
    for source, target in RECIPES.items():
        text = (HERE / source).read_text(encoding="utf-8")
        if f'"{found[1]}"' not in text:
            fail(f"packaging/{source} does not have the version {found[1]} of {archive.name}")
        file = folder / target
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(re.sub(r"@([A-Z0-9]+)@", lambda place: places[place[1]], text), encoding="utf-8")
        print(file)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        raise SystemExit("usage: recipes.py ARCHIVE URL FOLDER")
    main(pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]))
