# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes wrong, in one line for the user."""


class BadArtefact(Exception):
    """A file that is missing, damaged or of another kind, or a wrong request."""


class CannotWrite(Exception):
    """A file or disk error."""
