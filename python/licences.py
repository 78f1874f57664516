# SPDX-License-Identifier: Apache-2.0
"""licences.py FOLDER MODULE [TEXTS]: puts the licences of everything in a wheel into its metadata, as texts and as an expression.

FOLDER  the wheel, repaired by auditwheel and unpacked
MODULE  the extension module before the repair; this module still loads the system's libraries, which the wheel contains as copies
TEXTS   a folder with NAME.copyright for each library NAME that is linked into the module, as embree.sh leaves it for Embree, and
        for each library of the wheel that no Debian package has

Debian keeps the licence of each package in /usr/share/doc, and the texts that it refers to in /usr/share/common-licenses. The
module itself contains parts of nanobind and of its robin_map. The Python that runs this script must have the same nanobind that
built the module.
"""
import importlib.metadata
import pathlib
import re
import subprocess
import sys

# The licences of libraries by SPDX's names. The module's licence is in pyproject.toml.
GCC = "GPL-3.0-or-later WITH GCC-exception-3.1"
EXPRESSIONS = {"libembree": "Apache-2.0", "libtbb": "Apache-2.0", "libgomp": GCC, "libgcc_s": GCC, "libstdc++": GCC,
               "nlohmann-json": "MIT"}

DOCUMENTS, COMMON = pathlib.Path("/usr/share/doc"), pathlib.Path("/usr/share/common-licenses")


def fail(text):
    raise SystemExit(f"licences.py: {text}")


def package_of(library):
    """Returns the Debian package that contains the library. The package may list the file below /lib, which is /usr/lib."""
    for path in (library, pathlib.Path("/", *library.parts[2:])):
        answer = subprocess.run(["dpkg-query", "-S", path], capture_output=True, text=True, check=False)
        if answer.returncode == 0:
            return re.split("[:,]", answer.stdout)[0]
    return fail(f"no Debian package has {library}, so its licence is unknown")


def expression_of(own, libraries):
    """Returns the licence expression of the module and of the libraries in the wheel."""
    parts = own.split(" AND ")
    for name in libraries:
        stem = re.match(r"lib[a-z_+]+|nlohmann-json", name)[0]
        parts.append(EXPRESSIONS.get(stem) or fail(f"the SPDX expression of {name} is unknown; EXPRESSIONS lacks {stem}"))
    return " AND ".join(dict.fromkeys(parts))


def texts_of_nanobind():
    """Returns the licences of nanobind and of robin_map. The licence of robin_map is the comment at the top of its header."""
    files = {file.name: file for file in importlib.metadata.files("nanobind")}
    header = files["robin_map.h"].read_text(encoding="utf-8")
    comment = header[: header.index("*/") + 2]
    if "Permission is hereby granted" not in comment:
        fail("robin_map.h of nanobind does not begin with its licence")
    return {"nanobind.copyright": files["LICENSE"].read_text(encoding="utf-8"), "robin_map.copyright": comment + "\n"}


def main(folder, module, given=()):
    lines = subprocess.run(["ldd", module], capture_output=True, text=True, check=True).stdout.splitlines()
    found = {path.name: path for line in lines if "=> /" in line for path in [pathlib.Path(line.split()[2]).resolve()]}
    (metadata,) = folder.glob("*.dist-info/METADATA")
    licences = metadata.parent / "licenses"
    texts, libraries = {}, []
    given = {file.stem: file for file in given}
    for bundled in sorted(folder.glob("riis.libs/*")):
        name = re.sub(r"-[0-9a-f]{8}(?=\.so)", "", bundled.name)  # auditwheel appends a part of the checksum
        library = found.get(name) or fail(f"{module} loads no {name}, which the wheel has as {bundled.name}")
        libraries.append(name)
        stem = re.match("lib[a-z_+]+", name)[0]
        if stem in given:
            continue
        package = package_of(library)
        copyright_ = DOCUMENTS / package / "copyright"
        if not copyright_.is_file():
            fail(f"{copyright_} is missing, so the licence of {name} is unknown")
        texts[f"{package}.copyright"] = copyright_.read_text(encoding="utf-8")
        print(f"{bundled.name}: {copyright_}")
    if not libraries:
        fail(f"{folder}/riis.libs has no library")
    for name, text in given.items():
        libraries.append(name)
        texts[text.name] = text.read_text(encoding="utf-8")
        print(f"{name}: {text}")
    for name in re.findall(rf"{COMMON}/([A-Za-z0-9.+-]*[A-Za-z0-9])", "".join(texts.values())):
        if (COMMON / name).is_file():
            texts[f"common-licenses/{name}"] = (COMMON / name).read_text(encoding="utf-8")
    texts.update(texts_of_nanobind())
    for name, text in texts.items():
        (licences / name).parent.mkdir(parents=True, exist_ok=True)
        (licences / name).write_text(text, encoding="utf-8")
    head, blank, rest = metadata.read_text(encoding="utf-8").partition("\n\n")
    own = re.search("^License-Expression: (.*)$", head, re.MULTILINE) or fail(f"{metadata} has no License-Expression")
    head = head.replace(own[0], f"License-Expression: {expression_of(own[1], libraries)}")
    metadata.write_text("".join([head] + [f"\nLicense-File: {name}" for name in texts] + [blank, rest]), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        raise SystemExit("usage: licences.py FOLDER MODULE [TEXTS]")
    folder, module, *given = map(pathlib.Path, sys.argv[1:])
    files = [file for texts in given for file in sorted(texts.glob("*.copyright"))]
    if given and not files:
        fail(f"{given[0]} has no file NAME.copyright")
    main(folder, module, files)
