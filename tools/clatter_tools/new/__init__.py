# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter new`: folders that run, from a sample or from the user's part."""
