"""The values of a page's parts, looked at before viser takes them: one viewer's bad value costs nothing but itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from report.live.messages import complaint

if TYPE_CHECKING:
    from viser import ClientHandle


def guard_values(client: ClientHandle, say: Callable[[str], None]) -> None:
    """From now on a viewer's parts take only values they can have; of others the viewer is told why not.

    viser sets a value before anybody is asked, and has no public way to come between: what it does itself then is done
    here, after a look.
    """
    from viser._messages import GuiUpdateMessage

    gui = client.gui
    connection: Any = gui._websock_interface

    async def take(client_id: Any, message: GuiUpdateMessage) -> None:
        part = gui._gui_input_handle_from_uuid.get(message.uuid)
        if part is None:
            return
        if wrong := complaint(part, message.updates.get("value")):
            say(wrong)
        else:
            await gui._handle_gui_updates(client_id, message)

    connection.unregister_handler(GuiUpdateMessage)
    connection.register_handler(GuiUpdateMessage, take)
