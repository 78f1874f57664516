# SPDX-License-Identifier: Apache-2.0
"""Every function of riis.h is bound, or left out for a reason (bound.py). All that is public has a text."""

import ast
import inspect
import pathlib
import re

import bound
import riis

ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_every_function_is_bound_or_left_out():
    assert bound.check(ROOT) == []
    for name in bound.BOUND.values():
        found = riis
        for part in name.split("."):
            found = getattr(found, part)


def test_the_check_finds_what_is_missing(monkeypatch):
    monkeypatch.delitem(bound.BOUND, "riis_mark_nodes")
    monkeypatch.setitem(bound.BOUND, "riis_nothing", "mark")
    wrong = bound.check(ROOT)
    assert "riis_mark_nodes is not in python/tests/bound.py" in wrong
    assert "riis_nothing of python/tests/bound.py is not in riis.h" in wrong
    assert "riis_nothing is not called in python/src" in wrong


def test_options_of_surfaces_are_the_fields_of_their_struct():
    header = (ROOT / "include/riis/riis.h").read_text(encoding="utf-8")
    struct = re.search(r"typedef struct riis_surface_options \{(.*?)\n\}", header, re.DOTALL)[1]
    code = re.sub(r"/\*.*?\*/", "", struct, flags=re.DOTALL)
    fields = set(re.findall(r"(\w+)(?:\[3\])?;", code)) - {"struct_size", "reserved"}
    try:
        riis.Surface(riis.Valve(), nothing=1)
    except TypeError as refusal:
        options = set(str(refusal).split("the options are ")[1].split(", "))
    assert options == fields


def public_objects():
    for name in riis.__all__:
        found = getattr(riis, name)
        if not (inspect.isclass(found) or callable(found)):
            continue
        yield name, found
        if inspect.isclass(found) and found.__module__.startswith("riis"):
            for member, value in vars(found).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    if not hasattr(tuple, member) and not hasattr(int, member):
                        yield f"{name}.{member}", value


def test_everything_public_has_a_text():
    names = dict(public_objects())
    assert len(names) > 90
    inherited = {"opening_and_rate"}  # the laws of time have the text of their base
    missing = [n for n, value in names.items() if not value.__doc__ and n.split(".")[-1] not in inherited]
    assert not missing


def test_the_stub_has_every_name():
    stub = pathlib.Path(riis.__file__).with_name("_riis.pyi").read_text(encoding="utf-8")
    tree = ast.parse(stub)
    stubs = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    for name, found in vars(riis._riis).items():
        if name.startswith("__") or isinstance(found, (int, float)):
            continue
        assert name in stubs or name.startswith("_"), name
        if inspect.isclass(found):
            members = {node.name: node for node in stubs[name].body if isinstance(node, ast.FunctionDef)}
            for member in vars(found):
                if not member.startswith("_"):
                    assert member in members, f"{name}.{member}"
                    assert members[member].returns is not None, f"{name}.{member} has no annotation"
    assert pathlib.Path(riis.__file__).with_name("py.typed").exists()
