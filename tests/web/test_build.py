"""The page's built files are those of its sources, and its types those of the server."""

import hashlib
import json
import shutil
import subprocess
from pathlib import Path

import pytest

from sgim.web.typescript import typescript

ROOT = Path(__file__).parent.parent.parent
SOURCES = ROOT / "web"
BUILT = ROOT / "src" / "sgim" / "web" / "static"

AGAIN = "build the page again: cd web && npm ci && npm run build"


def test_the_built_files_are_those_of_the_sources() -> None:
    seal = json.loads((BUILT / "built.json").read_text("utf-8"))
    for folder, digests in ((SOURCES, seal["sources"]), (BUILT, seal["built"])):
        for name, digest in digests.items():
            found = hashlib.sha256((folder / name).read_bytes()).hexdigest()
            assert found == digest, f"{name} has changed; {AGAIN}"
    sources = {
        path.relative_to(SOURCES).as_posix()
        for folder in ("src", "public")
        for path in (SOURCES / folder).rglob("*")
        if path.is_file()
    }
    assert sources <= seal["sources"].keys(), AGAIN
    there = {path.name for path in BUILT.iterdir()} - {"built.json"}
    assert there == seal["built"].keys(), AGAIN


def test_the_page_has_the_server_s_types() -> None:
    again = "python -m sgim.web.typescript web/src/protocol.ts"
    assert (SOURCES / "src" / "protocol.ts").read_text("utf-8") == typescript(), again


def test_the_built_files_are_small_and_load_nothing_from_elsewhere() -> None:
    assert sum(path.stat().st_size for path in BUILT.iterdir()) < 900_000
    page = (BUILT / "index.html").read_text("utf-8")
    assert "//" not in page.replace("<!doctype html>", "")
    style = (BUILT / "page.css").read_text("utf-8")
    assert "url(" not in style
    assert "@import" not in style


@pytest.mark.skipif(
    shutil.which("node") is None or not (SOURCES / "node_modules").is_dir(),
    reason="Node or the page's packages are not installed",
)
def test_building_again_gives_the_same_files(tmp_path: Path) -> None:
    command = ["node", "node_modules/vite/bin/vite.js", "build", "--outDir", str(tmp_path)]
    done = subprocess.run(command, cwd=SOURCES, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    for path in tmp_path.iterdir():
        assert path.read_bytes() == (BUILT / path.name).read_bytes(), f"{path.name}: {AGAIN}"
