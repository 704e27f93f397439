# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads clatter's artefacts: information, reports and pictures."""
