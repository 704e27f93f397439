# SPDX-License-Identifier: GPL-3.0-or-later
"""What a hard case did: expectations that also print the figure and its limit, for the page of `make hard`."""


def observed(what):
    """One line of the page: `[ observed ] refused: ...`."""
    print(f"[ observed ] {what}", flush=True)


def expect_at_most(test, what, value, limit):
    """Expects value <= limit and prints `[ observed ] largest residual: 2e-13 (at most 1e-09)`."""
    observed(f"{what}: {value:.3g} (at most {limit:.3g})")
    test.assertLessEqual(value, limit, what)


def expect_at_least(test, what, value, limit):
    """Expects value >= limit and prints `[ observed ] smallest MAC: 1 (at least 0.9)`."""
    observed(f"{what}: {value:.3g} (at least {limit:.3g})")
    test.assertGreaterEqual(value, limit, what)
