"""The layout that the design promises: who may know whom, no world in the learner, short files."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "src" / "sgim"

WORDS = {"arrays", "errors", "frozen", "spaces", "records", "streams", "task"}
"""The words of the domain, and what everything may use."""

SPINE = (
    {"events", "demonstrations", "mixtures"},
    {"memory"},
    {"policy"},
    {"outcome"},
    {"strategy"},
    {"ledger", "openings", "transitions", "answers", "learner"},
    {
        "mixture_settings",
        "configurations",
        "parts",
        "labels",
        "mixture_algorithms",
        "algorithms",
    },
    {"runs"},
    {"experiments"},
    {"claims"},
    {"figures"},
    {"reproductions"},
    {"web"},
)
"""Each may know those before it, and its own."""

RECOGNITION = {"recognition"}
"""Pictures and what is recognised in them: worlds have it make features, and learners learn."""

WORLD = {"environments", "teachers", "primitives"}
"""Worlds know the words and each other; no part of a learner knows them."""

MEASURES = {"statistics"}
"""Pure functions on arrays: they know the words, and those who measure runs know them."""

DRIVERS = ("runs", "experiments", "claims", "figures", "reproductions", "web")
"""What brings learners and worlds together, and measures them."""

LEARNER_CODE = (
    "mixtures",
    "memory",
    "policy",
    "outcome",
    "strategy",
    "learner.py",
    "mixture_settings.py",
    "configurations.py",
)

WORLD_NAMES = {
    "throw",
    "throwing",
    "arm",
    "place",
    "fishing",
    "rod",
    "toy",
    "hockey",
    "puck",
    "mallet",
    "vocal",
    "vocalisation",
    "tract",
    "vowel",
}

ORDINARY_WORDS = {("outcome", "place")}
"""Identifiers that are the English word: a region tree's records have a place in the unit box."""

LONGEST_FILE = 350
HEAVY = (
    "scipy",
    "matplotlib",
    "tyro",
    "rich",
    "joblib",
    "mujoco",
    "cv2",
    "starlette",
    "uvicorn",
)


def allowed(part: str) -> set[str] | None:
    """The parts that one part of the package may import; None for all."""
    if part.startswith(("cli", "__")) or part == "testing":
        return None
    if part in WORDS | WORLD | MEASURES | RECOGNITION:
        return WORDS | (WORLD | RECOGNITION if part in WORLD else set())
    known = set(WORDS)
    for level in SPINE:
        known |= level
        if part in level:
            known |= RECOGNITION if part == "labels" else set()
            return known | (WORLD | MEASURES | RECOGNITION if part in DRIVERS else set())
    raise AssertionError(
        f"src/sgim has a part {part!r} with no place in the design: add it to tests/test_layout.py"
    )


def part_of(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def sources(*names: str) -> list[Path]:
    """The package's files, or those of the named files and folders in it."""
    chosen = [PACKAGE / name for name in names] or [PACKAGE]
    return sorted(p for c in chosen for p in (c.rglob("*.py") if c.is_dir() else [c]))


def imported(tree: ast.Module, path: Path) -> Iterator[tuple[str, int]]:
    """Each part of the package that a file imports, wherever in the file, with its line."""
    package = ["sgim", *path.relative_to(PACKAGE).parent.parts]
    for node in ast.walk(tree):
        modules: list[str] = []
        if isinstance(node, ast.Import):
            modules = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) + 1 - node.level] if node.level else []
            module = ".".join([*base, *([node.module] if node.module else [])])
            modules = [module]
            if module == "sgim":
                modules = [f"sgim.{alias.name}" for alias in node.names]
        for module in modules:
            top, _, rest = module.partition(".")
            if top == "sgim":
                yield rest.partition(".")[0] or "__init__", node.lineno


def test_every_part_imports_only_parts_that_it_may_know() -> None:
    wrong = []
    for path in sources():
        part = part_of(path)
        known = allowed(part)
        if known is None:
            continue
        for other, line in imported(ast.parse(path.read_text("utf-8")), path):
            if other not in known | {part}:
                wrong.append(f"{path.relative_to(ROOT)}:{line} imports sgim.{other}")
    assert not wrong, "\n".join(wrong)


def test_nothing_in_the_package_imports_the_command_line_or_the_conformance_suites() -> None:
    wrong = []
    for path in sources():
        part = part_of(path)
        if part.startswith(("cli", "__main__")):
            continue
        for other, line in imported(ast.parse(path.read_text("utf-8")), path):
            if other != part and (other == "testing" or other.startswith("cli")):
                wrong.append(f"{path.relative_to(ROOT)}:{line} imports sgim.{other}")
    assert not wrong, "\n".join(wrong)


def names_in(tree: ast.Module) -> Iterator[tuple[str, int, bool]]:
    """Identifiers and strings, docstrings left out, each with its line and whether a string."""
    statements = (n.value for n in ast.walk(tree) if isinstance(n, ast.Expr))
    docstrings = {id(value) for value in statements if isinstance(value, ast.Constant)}
    for node in ast.walk(tree):
        line = getattr(node, "lineno", 0)
        match node:
            case ast.Name(id=name) | ast.Attribute(attr=name) | ast.arg(arg=name):
                yield name, line, False
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name) | ast.alias(name=name):
                yield name, line, False
            case ast.keyword(arg=str(name)):
                yield name, line, False
            case ast.Constant(value=str(text)) if id(node) not in docstrings:
                yield text, line, True


def words_of(name: str) -> set[str]:
    """The words of a snake_case or CamelCase name, or of a sentence."""
    return {word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+", name)}


def test_no_part_of_the_learner_names_a_world() -> None:
    found = set()
    for path in sources(*LEARNER_CODE):
        where = path.relative_to(ROOT).as_posix()
        for name, line, is_string in names_in(ast.parse(path.read_text("utf-8"))):
            for word in WORLD_NAMES & words_of(name):
                if is_string or (part_of(path), word) not in ORDINARY_WORDS:
                    found.add(f"{where}:{line} says {name!r}")
    assert not found, "\n".join(sorted(found))


def test_every_file_fits_in_the_head() -> None:
    folders = [PACKAGE, ROOT / "tests", ROOT / "benchmarks", ROOT / "docs"]
    lengths = {
        path.relative_to(ROOT).as_posix(): len(path.read_text("utf-8").splitlines())
        for folder in folders
        for path in folder.rglob("*.py")
    }
    long = [f"{path}: {n} lines" for path, n in sorted(lengths.items()) if n >= LONGEST_FILE]
    assert not long, f"files of {LONGEST_FILE} lines or more:\n" + "\n".join(long)


@pytest.mark.parametrize("module", ["sgim", "sgim.spaces", "sgim.records", "sgim.task"])
def test_importing_loads_nothing_that_is_slow_to_import(module: str) -> None:
    code = f"import sys, {module}; print(*sorted({{m.partition('.')[0] for m in sys.modules}}))"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60
    )
    assert not {*HEAVY} & {*done.stdout.split()}
