"""Reads clatter's artefacts: information, reports and pictures."""
