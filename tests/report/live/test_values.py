"""A viewer's parts take only values they can have; viser itself does the rest."""

from __future__ import annotations

import asyncio
from types import SimpleNamespace
from typing import Any

import pytest
from viser._messages import GuiUpdateMessage

from report.live.values import guard_values


@pytest.mark.parametrize(
    ("uuid", "updates", "done", "said"),
    [
        ("dt", {"value": 3.0}, True, []),
        ("dt", {"value": "three"}, False, ["dt [ms] = 'three': expected a number from 1 to 9"]),
        ("dt", {"value": 10.0}, False, ["dt [ms] = 10.0: expected a number from 1 to 9"]),
        ("gone", {"value": 3.0}, False, []),
    ],
)
def test_what_a_part_cannot_have_is_said_and_not_done(
    uuid: str, updates: dict[str, Any], done: bool, said: list[str]
) -> None:
    """What is for a part that is no more is nobody's; the only one who is told of a message is ours."""
    handlers: list[Any] = ["viser's"]
    told: list[str] = []
    passed: list[tuple[Any, ...]] = []

    async def pass_on(client_id: int, message: GuiUpdateMessage) -> None:
        passed.append((client_id, message))

    socket = SimpleNamespace(
        unregister_handler=lambda kind: handlers.remove("viser's") if kind is GuiUpdateMessage else None,
        register_handler=lambda kind, handler: handlers.append(handler) if kind is GuiUpdateMessage else None,
    )
    part = SimpleNamespace(value=2.0, label="dt [ms]", min=1, max=9)
    gui = SimpleNamespace(
        _websock_interface=socket, _gui_input_handle_from_uuid={"dt": part}, _handle_gui_updates=pass_on
    )
    guard_values(SimpleNamespace(gui=gui), told.append)  # type: ignore[arg-type]
    (handler,) = handlers
    message = GuiUpdateMessage(uuid, updates)
    asyncio.run(handler(7, message))
    assert passed == [(7, message)] * done
    assert told == said
