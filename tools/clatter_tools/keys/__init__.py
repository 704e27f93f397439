# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys of TOML files as data: what the programs and the tools read, printed, searched, as pages and as schemas for editors."""
