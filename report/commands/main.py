"""The command line `springlab`: which commands there are, each in a file of its name.

They are imported when they are called, so that `springlab --help` answers at once.
"""

from __future__ import annotations

import importlib
import os
import sys

import click

#: Matrices are small here, and processes run beside one another: more threads for each would wait for one another, at
#: twice the time. NumPy asks for it when it is imported, here and in every process that is started.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

#: Command, and what `--help` says of it without importing it. It is the function NAME_command of the module NAME.
COMMANDS = {
    "list": "Scenes, schemes, engines and experiments.",
    "simulate": "Run steppers, and show what the scene did: positions, forces, sag, energies; files of it.",
    "modes": "Natural frequencies, shapes and damping about the rest, and what springs carry there.",
    "compare": "Run many steppers on one scene: how far from the true motion, and why.",
    "identify": "Say which scheme a stepper is.",
    "explain": "Derive what a stepper computes, from the outside.",
    "stability": "Predict and measure the largest stable dt; map growth.",
    "translate": "What to type into engines for k and c, and what their own numbers mean.",
    "live": "Open a page where scenes run and everything can be changed.",
    "page": "Write the lab as one file that runs in a browser, with nothing installed.",
    "sweep": "Run steppers over a grid of parameters; nothing is lost.",
    "results": "Show or export what is in the store.",
    "versions": "Say what versions of an engine do, and what each changed.",
    "run": "Run experiments, and write their figures and tables.",
    "exercise": "Exercises, and a checker that names the mistake.",
    "report": "Write the report: every experiment on one page.",
}


class LazyGroup(click.Group):
    """A group that imports a command when it is called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The commands in the order above."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command, imported now; None for an unknown one."""
        if cmd_name not in COMMANDS:
            return None
        module = importlib.import_module(f"report.commands.{cmd_name}")
        command: click.Command = getattr(module, f"{cmd_name}_command")
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """As click does, with a suggestion for a command nobody has."""
        if args and args[0] not in COMMANDS:
            from reference.errors import unknown_name

            ctx.fail(str(unknown_name("command", args[0], COMMANDS)))
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """The commands with their one line each, from the table."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="springlab", message="%(prog)s %(version)s")
def springlab() -> None:
    """The lab that explains physics engines: it finds the scheme that each one steps by."""


def main() -> None:
    """Entry point: bad input is one line and exit code 2, never a traceback."""
    from reference.cache import remarks
    from report.commands.terminal import in_one_line, say

    code = 0

    def call() -> None:
        nonlocal code
        try:
            code = springlab.main(standalone_mode=False, prog_name="springlab") or 0
        except click.exceptions.Exit as ending:
            code = ending.exit_code
        except click.Abort:
            say("springlab: interrupted")
            code = 130
        except click.ClickException as error:
            say(f"springlab: {error.format_message()}")
            code = 2

    if not _somewhere():
        say("springlab: the folder this was called in is no more: expected another one (cd)")
        sys.exit(2)
    ending = in_one_line(call) or code
    for remark in remarks:
        say(f"springlab: {remark}")
    remarks.clear()  # they are told: another command of this process has its own
    sys.exit(ending)


def _somewhere() -> bool:
    """Whether the working folder is still there."""
    try:
        return bool(os.getcwd())
    except OSError:
        return False


if __name__ == "__main__":
    main()
