# SPDX-License-Identifier: GPL-3.0-or-later
"""Hand-off: the motion of a surface written for acoustic programs, one file per format.

A reader (field_source.py) returns a `Surface` and its `Motion`; every format writes these two and knows nothing of where
they come from.
"""
