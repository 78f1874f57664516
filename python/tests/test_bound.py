# SPDX-License-Identifier: Apache-2.0
"""Every function of riis.h is bound, or left out for a reason (bound.py). All public names have a docstring."""

import ast
import inspect
import pathlib
import re
import shutil

import bound
import numpy
import riis
from riis import _errors

ROOT = pathlib.Path(__file__).resolve().parents[2]
KINDS = (
    "aortic", "mitral", "coapting", "trileaflet", "bileaflet", "bicuspid", "quadricuspid", "mitral_coapting", "tricuspid",
)  # fmt: skip


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


def test_a_function_in_the_last_header_is_seen(monkeypatch, tmp_path):
    shutil.copytree(ROOT / "include", tmp_path / "include")
    with (tmp_path / "include/riis/laws.h").open("a", encoding="utf-8") as file:
        file.write("RIIS_API riis_status riis_planted(int32_t number);\n")
    planted = bound.header_of(tmp_path)
    monkeypatch.setattr(bound, "header_of", lambda root: planted)
    assert "riis_planted is not in python/tests/bound.py" in bound.check(ROOT)


def test_a_new_field_is_seen(monkeypatch):
    header = bound.header_of(ROOT)
    planted = header.replace("} riis_mark_list;", "  const double *planted_field, *twin[3]; /* (n_nodes) */\n} riis_mark_list;")
    monkeypatch.setattr(bound, "header_of", lambda root: planted)
    monkeypatch.setitem(bound.FIELDS_LEFT_OUT, "riis_marks.height", "used")
    assert bound.check(ROOT) == [
        "the field riis_mark_list.planted_field is neither used in python/src nor in FIELDS_LEFT_OUT",
        "the field riis_mark_list.twin is neither used in python/src nor in FIELDS_LEFT_OUT",
        "riis_marks.height of FIELDS_LEFT_OUT is used, or not in riis.h"]


def test_options_of_surfaces_are_the_fields_of_their_struct():
    header = bound.header_of(ROOT)
    struct = re.search(r"typedef struct riis_surface_options \{(.*?)\n\}", header, re.DOTALL)[1]
    code = re.sub(r"/\*.*?\*/", "", struct, flags=re.DOTALL)
    fields = set(re.findall(r"(\w+)(?:\[3\])?;", code)) - {"struct_size", "reserved"}
    try:
        riis.Surface(riis.Valve(), nothing=1)
    except TypeError as refusal:
        options = set(str(refusal).split("the options are ")[1].split(", "))
    assert options == fields | {"axis"}  # axis stands for rotation_axis and rotation_angle


def test_words_of_numbers_are_those_of_the_header():
    header = bound.header_of(ROOT)
    for name, words in _errors.WORDS.items():
        values = re.findall(rf"^ +RIIS_{name.upper()}_(\w+) = (\d+)", header, re.MULTILINE)
        assert [(word.lower(), int(value)) for word, value in values] == [(word, i) for i, word in enumerate(words)]
    values = re.findall(r"^ +RIIS_FIELD_(\w+) = (\d+)", header, re.MULTILINE)
    names = [name.removesuffix("_id").removeprefix("distance_").upper() for name in _errors.FIELDS]
    assert values == [(name, str(1 << bit)) for bit, name in enumerate(names)]


def test_names_in_messages_are_those_of_the_package(monkeypatch):
    for text in bound.texts_of_the_library(ROOT):
        for name in re.findall(r"\b(?:riis|Surface|Mesh|Marks|Valve)(?:\.\w+)+", _errors.in_python(text)):
            found = riis
            for part in name.removeprefix("riis.").split("."):
                found = getattr(found, part)
    for name, own in _errors._NAMES.items():
        if name in bound.BOUND:
            assert own.removeprefix("riis.") == bound.BOUND[name]
    monkeypatch.setattr(bound, "texts_of_the_library", lambda root: ["see riis_mesh_set_adjacency", "see riis_new_call"])
    assert [text for text in bound.check(ROOT) if "riis/_errors.py" in text] == [
        "python/riis/_errors.py lacks a name for the text 'see riis_new_call'"]


def test_descriptions_and_warnings_have_names_of_python():
    descriptions = [p.description for kind in KINDS for p in riis.Valve(kind).parameters.values()]
    assert any("Valve.set_open_state" in text for text in descriptions)
    assert not any(re.search("riis_|RIIS_", text) for text in descriptions)
    warnings = []
    riis.set_log(lambda level, message: warnings.append(message))
    try:
        far = riis.Mesh(1000.0 * numpy.random.default_rng(3).uniform(-1.0, 1.0, (2000, 3)))
        riis.mark(riis.Surface(riis.Valve("mitral")), far, allow_none=True)
    finally:
        riis.set_log(None)
    assert any("See scale and half_thickness of riis.Surface" in text for text in warnings)
    assert not any(re.search("riis_|RIIS_", text) for text in warnings)


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
    inherited = {"opening_and_rate"}  # the laws of time inherit the docstring of their base class
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
                    decorators = [ast.unparse(decorator) for decorator in members[member].decorator_list]
                    assert decorators in ([], ["property"], ["staticmethod"]), f"{name}.{member}"
                    assert isinstance(vars(found)[member], property) == (decorators == ["property"])
    assert pathlib.Path(riis.__file__).with_name("py.typed").exists()
