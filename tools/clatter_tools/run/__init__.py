# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter run`: make in a folder, watched."""
