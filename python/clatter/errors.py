# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes wrong, in one line for the user; the exit codes are those of all programs."""


class Refused(Exception):
    """Bad input (exit code 2)."""


class BadArtefact(Refused):
    """A file that is missing, damaged or of another kind, or a wrong request."""


class Failed(Exception):
    """A result that did not converge or was not proved (exit code 3)."""


class CannotWrite(Exception):
    """A file or disk error (exit code 4)."""
