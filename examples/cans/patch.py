# SPDX-License-Identifier: Apache-2.0
"""Puts the valve into the sources of CaNS, or takes it out.

patch.py FOLDER [--undo] [--sha256 HASH]
  FOLDER    CaNS's folder, with src/main.f90
  --undo    takes the valve out; src/main.f90 then has its old bytes
  --sha256  the hash of another src/main.f90 that you have read: the calls must fit it

The script inserts four calls into src/main.f90, and copies riis_valve.f90 and riis_pressure.f90 to src. Each line that the script
inserts ends with "! riis". A second call changes nothing. An unknown src/main.f90 is refused.
"""
import argparse
import hashlib
import pathlib
import sys

KNOWN = {"5d11e7364fde21ad9965c1514c69bd8340ad2352eefd6a69af8faf601dfbc731": "CaNS 245a233"}
HERE = pathlib.Path(__file__).parent
FILES = ["riis_valve.f90", "riis_pressure.f90"]
MARK = " ! riis\n"

# The beginning of a line in CaNS, and the lines to insert before or after it.
CALLS = [
    ("  use mod_updatep        , only: updatep\n", "after",
     "  use mod_riis_valve     , only: riis_valve_setup,riis_valve_apply,riis_valve_report"),
    ("                  lambdaxyp,['c','c','c'],ap,bp,cp,arrplanp,normfftp,rhsbp%x,rhsbp%y,rhsbp%z)\n", "after",
     "  call riis_valve_setup(n,lo,zc,zf,dzc,dzf,dzci,dzfi,arrplanp,normfftp,lambdaxyp,ap,bp,cp)"),
    ("      call bounduvw(cbcvel,n,bcvel,nb,is_bound,dl,dzc,dzf,u,v,w,.false.,-1)\n", "before",
     "      call riis_valve_apply(time,dt,dtrk,u,v,w,p,pp)"),
    ("    dpdl(:)     = -dpdl(:)*dti\n", "before",
     "    call riis_valve_report(istep,time,u,p)"),
]


class Refused(Exception):
    """Raised if the sources are of an unknown version."""


def hash_of(lines):
    return hashlib.sha256("".join(lines).encode("latin-1")).hexdigest()


def read(path):
    """Returns the lines of a file. Each byte becomes a character."""
    try:
        return path.read_bytes().decode("latin-1").splitlines(keepends=True)
    except OSError as error:
        raise Refused(f"cannot read {path}: {error.strerror}") from error


def write(path, lines):
    path.write_bytes("".join(lines).encode("latin-1"))


def patched(lines):
    """Returns the lines with the calls."""
    result = list(lines)
    for anchor, side, call in CALLS:
        if result.count(anchor) != 1:
            raise Refused(f"src/main.f90 has the line '{anchor.strip()}' {result.count(anchor)} times, not once")
        at = result.index(anchor) + (side == "after")
        result.insert(at, call + MARK)
    return result


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--undo", action="store_true")
    parser.add_argument("--sha256")
    words = parser.parse_args()
    source = words.folder / "src"
    try:
        lines = read(source / "main.f90")
        bare = [line for line in lines if not line.endswith(MARK)]
        found = hash_of(bare)
        if found not in KNOWN and found != words.sha256:
            known = " or ".join(f"{name}, {known}" for known, name in KNOWN.items())
            raise Refused(f"{source}/main.f90 without the valve has the SHA-256 {found}; known is {known}")
        wanted = bare if words.undo else patched(bare)
        for name in FILES:
            if words.undo and (source / name).exists() and (source / name).read_bytes() != (HERE / name).read_bytes():
                raise Refused(f"{source / name} was edited: move it away first")
        if wanted != lines:
            write(source / "main.f90", wanted)
        for name in FILES:
            target = source / name
            if words.undo:
                target.unlink(missing_ok=True)
            elif not target.exists():
                target.write_bytes((HERE / name).read_bytes())
            elif target.read_bytes() != (HERE / name).read_bytes():
                print(f"{target} was edited, and stays")
    except Refused as error:
        print(f"patch.py: {error}", file=sys.stderr)
        return 1
    changed = "is as it was" if wanted == lines else "has no call" if words.undo else f"has {len(CALLS)} calls"
    print(f"{source}/main.f90 {changed}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
