"""The pages that people write, laid together as one folder, with their links made to fit.

In the repository a page links to others by their place there, so that a repository's own pages show it well. On the
site they stand side by side. A link to a file that is no page, such as a source, becomes that file's name.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable
from pathlib import Path, PurePosixPath

from reference.errors import InputError

ROOT = Path(__file__).parents[2]

#: Folders of pages, and single pages; where they stand on the site.
FOLDERS = {"report/docs": "."}
FILES = {
    "README.md": "readme.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    "SECURITY.md": "security.md",
}

#: Pictures and whole pages that are shown or linked to, copied as they are.
COPIED = {"report/pictures": "pictures", "report/sample": "sample"}

#: The first page, and the last page of the reference that it lists.
INDEX, LAST = PurePosixPath("index.md"), "a-million-runs"

LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)")


def write_sources(folder: Path) -> None:
    """All pages into a folder. Raises InputError for a link to a file that is not there."""
    places = _places()
    for source, place in places.items():
        target = folder / place
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.suffix == ".md":
            text = moved(source.read_text(encoding="utf-8"), source, place, places)
            text = with_all(text, places.values()) if place == INDEX else text
            target.write_text(text, encoding="utf-8")
        else:
            shutil.copyfile(source, target)


def with_all(index: str, places: Iterable[PurePosixPath]) -> str:
    """The first page's text, with pages that it does not list behind the last of the reference."""
    pages = sorted(place.stem for place in places if place.suffix == ".md" and place != INDEX and len(place.parts) == 1)
    missing = [page for page in pages if not re.search(rf"^{re.escape(page)}$", index, re.MULTILINE)]
    return re.sub(rf"^{LAST}$", "\n".join([LAST, *missing]), index, flags=re.MULTILINE)


def _places() -> dict[Path, PurePosixPath]:
    """Where each file of the repository stands on the site."""
    found = {ROOT / name: PurePosixPath(place) for name, place in FILES.items()}
    for folder, place in {**FOLDERS, **COPIED}.items():
        for file in sorted((ROOT / folder).rglob("*")):
            if file.is_file() and ".ipynb_checkpoints" not in file.parts:
                found[file] = PurePosixPath(place) / file.relative_to(ROOT / folder).as_posix()
    return found


def moved(text: str, source: Path, place: PurePosixPath, places: dict[Path, PurePosixPath]) -> str:
    """A page's text with its links from where it stands on the site.

    Raises:
        InputError: for a link to a file that is not there.
    """

    def link(found: re.Match[str]) -> str:
        picture, words, address = found.groups()
        path, hash_sign, anchor = address.partition("#")
        if not path or "://" in address or address.startswith("mailto:"):
            return found[0]
        target = (source.parent / path).resolve()
        if target not in places and not target.exists() and not _generated(target):
            raise InputError(f"{source.relative_to(ROOT)}: ({address}): expected a file that is there")
        if target not in places and not _generated(target):
            return f"{words} (`{target.relative_to(ROOT).as_posix()}`)"
        to = places.get(target, PurePosixPath(target.name))
        up = "../" * (len(place.parts) - 1)
        return f"{picture}[{words}]({up}{to}{hash_sign}{anchor})"

    return LINK.sub(link, text)


def _generated(target: Path) -> bool:
    """Whether it is a page that is made: pages link to these as if they stood in report/docs."""
    from report.site.generated import PAGES

    return target.parent == ROOT / "report" / "docs" and target.suffix == ".md" and target.stem in PAGES
