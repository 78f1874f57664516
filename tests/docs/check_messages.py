# SPDX-License-Identifier: Apache-2.0
"""check_messages.py ROOT: every command that a message prints must be in messages.txt, with the test that runs it.

A command is a word of a shell in a literal of the sources, or an option that a message recommends. The texts of --help and the
descriptions of options do not count as messages. Prints how many commands the messages of each part have.
"""
import ast
import collections
import pathlib
import re
import sys
import tempfile

PARTS = {"program": ["src/program"], "library": ["src/riis", "src/riis_vtk", "src/common"],
         "Python": ["python/riis", "python/src", "src/paraview"]}
NO_MESSAGES = {"src/program/cli/help.cpp", "src/program/cli/command_options.cpp", "src/program/base/refusal.hpp",
               "python/riis/_errors.py"}  # the last two replace names in messages
COMMAND = re.compile(
    r"(?:riis (?:mark|check \w+|params|states|help|surface|size-field)\b|gmsh -|meshio convert |xvfb-run|git lfs"
    r"|pip install|apt-get install|python3 -m venv|reconstructParMesh|fluentMeshToFoam|numpy\.ascontiguousarray\("
    r"|make it by numpy\.zeros|mark with \w+=|pass whole=False"
    r"|--help lists|\b(?:write|give) --[a-z-]+|\bwrite $|^give $|--[a-z-]+ $|or --prefix NAME|--search neighbor|set RIIS_PYTHON)")
# A literal that ends in an option is advice only if a value follows.
VALUED = re.compile(r"(?:--half-thickness|--search) $")


def literals_of_cpp(text):
    """Yields the literals outside of comments, with neighbours joined."""
    text = re.sub(r"^\s*//.*$|//[^\n\"]*$", "", text, flags=re.MULTILINE)
    for found in re.finditer(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', text):
        yield "".join(part[1:-1].replace('\\"', '"') for part in re.findall(r'"(?:[^"\\\n]|\\.)*"', found[0]))


def literals_of_python(text):
    """Yields the literals without docstrings. {} stands for a formatted value."""
    tree = ast.parse(text)
    skipped = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            skipped.add(id(node.value))
        if isinstance(node, ast.JoinedStr):
            skipped.update(id(part) for part in node.values)
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            yield "".join(part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in skipped:
            yield node.value


def commands(root):
    """Returns all commands of messages, as (part, file, command)."""
    found = []
    for part, folders in PARTS.items():
        for folder in folders:
            for path in sorted((root / folder).rglob("*")):
                name = str(path.relative_to(root))
                if name in NO_MESSAGES or path.suffix not in (".cpp", ".hpp", ".h", ".py"):
                    continue
                text = path.read_text(encoding="utf-8")
                for literal in literals_of_python(text) if path.suffix == ".py" else literals_of_cpp(text):
                    for match in COMMAND.finditer(literal):
                        if match[0].startswith("--") and match[0].endswith(" ") and not VALUED.match(match[0]):
                            continue
                        found.append((part, name, match[0].strip()))
    return found


def problems_of(root, text):
    """Compares the sources with the lines of messages.txt. Returns the differences."""
    listed, problems = collections.Counter(), []
    tests = {path.name for folder in ("tests", "python/tests") for path in (root / folder).rglob("*")}
    for line in text.splitlines():
        if line and not line.startswith("#"):
            name, command, test = line.split(" | ")
            listed[name, command] += 1
            if not test.startswith("never: ") and test not in tests:
                problems.append(f"messages.txt: there is no test {test}")
    present = collections.Counter((name, command) for _, name, command in commands(root))
    problems += [f"{name} prints the command '{command}', which messages.txt lacks: name the test that runs it"
                 for name, command in (present - listed).elements()]
    return problems + [f"messages.txt: {name} does not print '{command}'" for name, command in (listed - present).elements()]


def check_itself():
    """Shows that each fault is found. Two files stand for the sources."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in (("src/program/a.cpp", '// "riis mark" in a comment\nfail("it leaks: "\n     "write --" "scale 2");\n'),
                           ("python/riis/a.py", '"""riis mark in a docstring"""\nraise Error(f"{x}: pip install {y}")\n'),
                           ("tests/test_a.c", "")):
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        lines = "src/program/a.cpp | write --scale | test_a.c\npython/riis/a.py | pip install | never: the network\n"
        assert not problems_of(root, lines), problems_of(root, lines)
        assert len(problems_of(root, "# nothing\n")) == 2
        for line in "python/riis/b.py | pip install | test_a.c\n", "src/program/a.cpp | riis mark | test_a.c\n":
            assert problems_of(root, lines + line) == [f"messages.txt: {line.split()[0]} does not print '{line.split(' | ')[1]}'"]
        assert problems_of(root, lines.replace("test_a", "test_b")) == ["messages.txt: there is no test test_b.c"]


def main(root):
    check_itself()
    root = pathlib.Path(root)
    problems = problems_of(root, pathlib.Path(__file__).with_name("messages.txt").read_text(encoding="utf-8"))
    if problems:
        sys.exit("\n".join(problems))
    for part in PARTS:
        print(f"{part}: {sum(one == part for one, _, _ in commands(root))} commands")


if __name__ == "__main__":
    main(*sys.argv[1:])
