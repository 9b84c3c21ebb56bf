# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program as a process of its own."""

import os
import re
import subprocess
import tempfile


class ReductionError(Exception):
    """Says in one sentence for the user why there is no result."""


class Program:
    """A run of the program in a folder. Its stderr is a terminal, because it shows its progress to nothing else."""

    def __init__(self, command, folder):
        self._summary = tempfile.TemporaryFile("w+", encoding="utf-8")
        self._terminal, for_the_program = os.openpty()
        os.set_blocking(self._terminal, False)
        try:
            self._process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=self._summary,
                                             stderr=for_the_program, start_new_session=True)
        except OSError as error:
            os.close(self._terminal)
            self._summary.close()
            raise ReductionError(f"The program '{command[0]}' does not start: {error.strerror}") from None
        finally:
            os.close(for_the_program)
        self._said = ""

    def is_running(self):
        is_running = self._process.poll() is None
        self._listen()
        return is_running

    @property
    def exit_code(self):
        return self._process.returncode

    @property
    def summary(self):
        """The lines that the program has printed at its end."""
        self._summary.seek(0)
        return self._summary.read().splitlines()

    @property
    def line(self):
        """What the program shows at present: its progress, or at the end its error."""
        return self._said.split("\r\x1b[K")[-1].strip().replace("\r\n", " ")

    @property
    def percentage(self):
        """How much of the reduction is done, or None when no reduction with a target is under way."""
        found = re.search(r"(\d+) %", self.line)
        return int(found[1]) if found else None

    def end(self):
        """Ends the program if it still runs."""
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
        os.close(self._terminal)
        self._summary.close()

    def _listen(self):
        try:
            while heard := os.read(self._terminal, 65536):
                self._said += heard.decode(errors="replace")
        except OSError:  # there is nothing more at present, or the program has ended
            pass
