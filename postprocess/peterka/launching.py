"""Starts the program and watches its output and progress; passes interrupts on to it.

On a terminal the program shows a bar, "\\r[####......]  41.3 %  5,432 cells/s  ETA 2 s"; so its stderr is a pseudo-terminal
here: what follows a carriage return is progress, all else is messages.
"""

import os
import pty
import re
import selectors
import signal
import subprocess
import sys
import tty
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

Progress = bool | Callable[[float], object]
BAR = re.compile(r" *(?:\[[#.]*\])? *(\d+(?:\.\d)?) %")
AT_ONCE = 1 << 16


@dataclass(frozen=True)
class Finished:
    """The exit code of a program and its output."""

    code: int
    stdout: str
    stderr: str


def launch(command: Sequence[str], environment: Mapping[str, str], progress: Progress = False) -> Finished:
    """Runs a program to its end. `progress`: True shows its bar on our stderr; a function is called with the finished share,
    0 to 1, whenever it changes; False: nothing. On KeyboardInterrupt the program is interrupted too, and waited for."""
    ours, its = pty.openpty()
    tty.setraw(its)  # keeps line ends as written
    try:
        process = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=its)
        os.close(its)
        its = -1
        try:
            return _listen(process, ours, _Bar(progress))
        except BaseException:
            process.send_signal(signal.SIGUSR1)  # mpirun passes it on at once, and SIGINT after two seconds
            raise
        finally:
            process.wait()
            if process.stdout:
                process.stdout.close()
    finally:
        for descriptor in (ours, its):
            if descriptor >= 0:
                os.close(descriptor)


def _listen(process: subprocess.Popen[bytes], terminal: int, bar: "_Bar") -> Finished:
    assert process.stdout is not None
    written = {process.stdout.fileno(): bytearray(), terminal: bytearray()}
    with selectors.DefaultSelector() as selector:
        for descriptor in written:
            selector.register(descriptor, selectors.EVENT_READ)
        while selector.get_map():
            for key, _ in selector.select():
                piece = _read(key.fd)
                written[key.fd] += piece
                if key.fd == terminal:
                    bar.look_at(piece)
                if not piece:
                    selector.unregister(key.fd)
    stdout, stderr = (bytes(text).decode("utf-8", "replace") for text in written.values())
    return Finished(process.wait(), stdout, _without_bar(stderr))


def _read(descriptor: int) -> bytes:
    try:
        return os.read(descriptor, AT_ONCE)
    except OSError:  # the other end of the terminal is closed
        return b""


def _without_bar(text: str) -> str:
    return "\n".join(line for line in re.split(r"[\r\n]+", text) if line and not BAR.match(line))


class _Bar:
    """Reports a program's progress, from the end of its latest output."""

    def __init__(self, progress: Progress) -> None:
        self.progress, self.rest = progress, b""
        self.told: float | None = None

    def look_at(self, piece: bytes) -> None:
        """piece: the program's output; empty once it has ended."""
        if self.progress is False:
            return
        *lines, self.rest = re.split(rb"[\r\n]+", self.rest + piece)
        bars = [bar for line in lines if (bar := BAR.match(line.decode("utf-8", "replace")))]
        if bars:
            self.tell(bars[-1])
        if not piece and self.progress is True and self.told is not None:
            sys.stderr.write("\n")

    def tell(self, bar: re.Match[str]) -> None:
        share = float(bar[1]) / 100
        if self.progress is True:
            sys.stderr.write(f"\r{bar.string.rstrip()}")
            sys.stderr.flush()
        elif share != self.told and self.progress:
            self.progress(share)
        self.told = share
