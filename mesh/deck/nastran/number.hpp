// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Numbers as the writer writes them.
#include <string>

namespace clatter::mesh::deck {

/// The most exact text of a finite number in `width` columns; "1.5-3" for 0.0015 and the like.
std::string nastran_number(double value, int width);

}  // namespace clatter::mesh::deck
