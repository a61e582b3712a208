"""A page taken apart: what it would ask for, its sections, its links, its words."""

from __future__ import annotations

import re
from functools import cached_property, lru_cache
from html.parser import HTMLParser

#: Attributes that make a browser fetch or go somewhere, and elements that do without one.
ADDRESSES = ("src", "href", "xlink:href", "srcset", "poster", "data", "action", "formaction", "background", "ping")
FETCHING = ("link", "iframe", "frame", "object", "embed", "base", "form")

#: What a script could ask for something with.
ASKING = ("http", "//www", "fetch", "import", "XMLHttp", "WebSocket", "EventSource", "sendBeacon", "location")


class Page(HTMLParser):
    """What a page is made of.

    Attributes:
        elements: every element's name and attributes, in order.
        styles: the texts of all style elements and attributes.
        scripts: the texts of all script elements.
    """

    def __init__(self, html: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str]]] = []
        self.styles: list[str] = []
        self.scripts: list[str] = []
        self._words: list[str] = []
        self._inside: list[str] = []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note an element."""
        values = {name: value or "" for name, value in attrs}
        self.elements.append((tag, values))
        self.styles.append(values.get("style", ""))
        if tag in ("style", "svg", "script"):
            self._inside.append(tag)

    def handle_endtag(self, tag: str) -> None:
        """Leave an element."""
        if self._inside and self._inside[-1] == tag:
            self._inside.pop()

    def handle_data(self, data: str) -> None:
        """Note a text."""
        if "style" in self._inside:
            self.styles.append(data)
        elif "script" in self._inside:
            self.scripts.append(data)
        elif not self._inside:
            self._words.append(data)

    @cached_property
    def words(self) -> str:
        """The text outside of styles, pictures and scripts."""
        return "".join(self._words)

    def attributes(self, name: str) -> list[str]:
        """The values of an attribute, wherever it stands."""
        return [attributes[name] for _, attributes in self.elements if name in attributes]

    def of(self, tag: str) -> list[dict[str, str]]:
        """The attributes of all elements of a name."""
        return [attributes for name, attributes in self.elements if name == tag]


@lru_cache(maxsize=2)
def page_of(html: str) -> Page:
    """A page taken apart, once for all that look at it."""
    return Page(html)


def check_self_contained(html: str) -> None:
    """Nothing on the page asks for anything from anywhere: all its addresses are data: or places on the page itself."""
    page = page_of(html)
    for tag, attributes in page.elements:
        assert tag not in FETCHING, f"<{tag}> can fetch something"
        assert "http-equiv" not in attributes
        for name in ADDRESSES:
            check_address(attributes.get(name, "#"), f"<{tag} {name}>")
    drawn = ("clip-path", "fill", "stroke", "mask", "filter", "marker-start", "marker-mid", "marker-end")
    styles = [*page.styles, *(style for name in drawn for style in page.attributes(name))]
    for script in page.scripts:
        for word in ASKING:
            assert word not in script, f"a script says {word}"
    for style in styles:
        assert "@import" not in style
        for address in re.findall(r"url\(\s*['\"]?([^'\")]*)", style):
            check_address(address, "url()")


def check_address(address: str, where: str) -> None:
    """It carries its data with it, or is a place on the page; a link may lead to the lab in the file beside it."""
    beside = ("lab.html#",) if where == "<a href>" else ()
    assert address.startswith(("data:", "#", *beside)), f"{where} asks for {address[:80]}"
