"""The command that opens the live lab: live."""

from __future__ import annotations

import os
import signal
import sys

import click

from report.commands.options import scene_argument, steppers_option

#: Addresses that only this machine can reach.
LOOPBACK = ("127.0.0.1", "localhost", "::1")


@click.command("live")
@scene_argument
@steppers_option("Who steps a lane, up to four of them, files of your own too; kick_drift where left out.")
@click.option(
    "--host",
    metavar="ADDRESS",
    default="127.0.0.1",
    show_default=True,
    help="The address to listen at; 0.0.0.0 is every one.",
)
@click.option("--port", default=8080, show_default=True, help="0 for any that is free.")
@click.option(
    "--allow-origin",
    "origins",
    multiple=True,
    metavar="ORIGIN",
    help="Another page's origin that is let in, as https://lab.example; the lab's own page always is.",
)
@click.option("--open/--no-open", "show", default=True, help="Open the page in the browser.")
def live_command(
    scene: str, names: tuple[str, ...], host: str, port: int, origins: tuple[str, ...], show: bool
) -> None:
    """Open a page where SCENE (a name or a TOML file) runs, and everything can be changed while it does."""
    from report.live.server import LiveServer

    # To be told to end is as good as Ctrl-C: nothing is left behind.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    server = LiveServer(scene, host, port, names or ("kick_drift",), origins)
    try:
        if host not in LOOPBACK:
            print(
                f"listening at {host}: whoever can reach this machine can use the lab and its processor",
                file=sys.stderr,
            )
        print(f"springlab live: {server.address} (Ctrl-C ends it)", flush=True)
        if show and not _opened(server.address):
            print(f"no browser found here: open {server.address} in yours", file=sys.stderr)
        server.wait()
    except KeyboardInterrupt:
        print()
    finally:
        server.stop()


def _opened(address: str) -> bool:
    """Whether a browser with a window took it; one that would take over the terminal is not asked."""
    import webbrowser

    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        return False
    return webbrowser.open(address)
