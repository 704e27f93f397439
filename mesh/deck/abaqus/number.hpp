// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Numbers as the writer writes them.
#include <string>

namespace clatter::mesh::deck {

/// A number in at most 20 characters, the limit of CalculiX: the shortest text that reads back as
/// the same double, or, if that is longer, as many digits as fit. Numbers above 0.01 are exact;
/// smaller numbers of 17 digits lose up to 5e-15 of their value (5e-14 below 1e-80).
std::string abaqus_number(double value);

}  // namespace clatter::mesh::deck
