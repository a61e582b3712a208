"""Where the live page may listen, what it shows of viser's own, who is let in, and what is said of them; no server."""

from __future__ import annotations

import asyncio
import socket
from types import SimpleNamespace
from typing import Any
from unittest.mock import MagicMock, call

import pytest

from reference.errors import InputError
from report.live import server as module
from report.live.server import FULL, MOST_VIEWERS, LiveServer, check_port, company


def test_a_port_that_is_free_is_taken_and_one_that_is_taken_is_not() -> None:
    """One line, with the port and the address; it is free again afterwards."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(
            InputError, match=rf"cannot listen at port {port} of 127\.0\.0\.1 \(.+\): try another --port"
        ):
            check_port("127.0.0.1", port)
    check_port("127.0.0.1", 0)
    check_port("127.0.0.1", 0)


@pytest.mark.parametrize("port", [-1, 65536])
def test_a_number_that_is_no_port_is_refused(port: int) -> None:
    """Beyond either end of them."""
    with pytest.raises(InputError, match=f"port = {port}: expected a number from 0 to 65535"):
        check_port("127.0.0.1", port)


def test_a_name_of_several_addresses_means_the_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """As it does for what listens; the last one of both port numbers is one, too."""

    def addresses(host: str, port: int, type: int) -> list[Any]:
        stream = (type, 6, "")
        return [(socket.AF_INET, *stream, ("127.0.0.1", 0)), (socket.AF_INET, *stream, ("192.0.2.1", 0))]

    monkeypatch.setattr(socket, "getaddrinfo", addresses)
    check_port("lab.example", 65535)
    monkeypatch.setattr(socket, "getaddrinfo", lambda *given, type: addresses(*given, type)[::-1])
    with pytest.raises(InputError, match=r"cannot listen at port 65535 of lab\.example"):
        check_port("lab.example", 65535)


@pytest.mark.parametrize(
    ("number", "said"),
    [(0, "you are the only viewer"), (1, "you are the only viewer"), (2, "2 viewers are here, each with their own")],
)
def test_how_many_are_there_is_said(number: int, said: str) -> None:
    """And how many can be."""
    assert company(number) == f"This simulation is yours alone; {said}. At most {MOST_VIEWERS} can be."


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> tuple[LiveServer, Any]:
    """A lab for which viser does nothing but note what it is asked for; and that."""
    viser = MagicMock()

    class Server:
        """In place of viser's."""

        def __init__(self, **how: Any) -> None:
            self.how, self.gui, self.scene = how, viser.gui, viser.scene
            viser.server = self

        def __getattr__(self, name: str) -> Any:
            return getattr(viser, name)

    monkeypatch.setattr("viser.ViserServer", Server)
    monkeypatch.setattr("viser.ClientHandle", SimpleNamespace)
    monkeypatch.setattr(module, "Page", MagicMock(side_effect=lambda *given: MagicMock(given=given)))
    return LiveServer("spring", "127.0.0.1", 0, ["semi_implicit_euler"]), viser


def test_nothing_of_visers_own_is_shown_and_no_way_in_is_opened(made: tuple[LiveServer, Any]) -> None:
    """Neither logo nor share button, nor what takes a page seconds without a graphics card; up is up."""
    lab, viser = made
    assert viser.server.how == {"host": "127.0.0.1", "port": 0, "label": "springlab live", "verbose": False}
    theme = viser.gui.configure_theme.call_args.kwargs
    assert (theme["show_logo"], theme["show_share_button"], theme["control_width"]) == (False, False, "large")
    assert viser.scene.configure_environment_map.call_args == call(hdri=None)
    assert viser.scene.configure_default_lights.call_args == call(cast_shadow=False)
    assert viser.scene.add_light_ambient.call_args.kwargs["intensity"] > 1
    assert viser.scene.set_up_direction.call_args == call("+y")
    assert viser.server.request_share_url(verbose=True) is None
    viser.get_port.return_value = 8081
    for host, said in (("0.0.0.0", "localhost"), ("127.0.0.1", "localhost"), ("::", "localhost"), ("10.0.0.5",) * 2):
        viser.get_host.return_value = host
        assert lab.address == f"http://{said}:8081"


def test_each_viewer_has_a_page_until_there_are_too_many(made: tuple[LiveServer, Any]) -> None:
    """That is said, and how many there are; who leaves makes room, and ends a page."""
    lab, viser = made
    (welcome,), (goodbye,) = viser.on_client_connect.call_args.args, viser.on_client_disconnect.call_args.args
    viewers = [SimpleNamespace(client_id=i, gui=MagicMock()) for i in range(MOST_VIEWERS + 1)]
    for viewer in viewers:
        asyncio.run(welcome(viewer))
    assert [*lab.pages] == [*range(MOST_VIEWERS)]
    *inside, outside = viewers
    outside.gui.add_markdown.assert_called_once_with(FULL.format(MOST_VIEWERS))
    page = lab.pages[3]
    client, scene, steppers, said = page.given  # type: ignore[attr-defined]
    assert (client, scene, steppers) == (inside[3], "spring", ("kick_drift",))
    assert said() == company(MOST_VIEWERS)
    asyncio.run(goodbye(inside[3]))
    asyncio.run(goodbye(inside[3]))
    asyncio.run(goodbye(outside))
    page.end.assert_called_once_with()  # type: ignore[attr-defined]
    asyncio.run(welcome(outside))
    assert {*lab.pages} == {*range(MOST_VIEWERS + 1)} - {3}
    pages = [*lab.pages.values()]
    lab.stop()
    assert [page.mock_calls for page in pages] == [[call.end(), call.wait()]] * MOST_VIEWERS  # type: ignore[attr-defined]
    viser.stop.assert_called_once_with()
    assert lab.pages == {}


def test_it_waits_for_ever(made: tuple[LiveServer, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """Until something ends it from outside."""
    slept: list[float] = []

    def sleep(seconds: float) -> None:
        slept.append(seconds)
        if len(slept) == 3:
            raise KeyboardInterrupt

    monkeypatch.setattr(module, "time", SimpleNamespace(sleep=sleep))
    with pytest.raises(KeyboardInterrupt):
        made[0].wait()
    assert len(slept) == 3
