// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The text of one field of a deck: blanks, capitals, numbers, and how messages show it.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace clatter::mesh::deck {

/// Without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);
/// a to z as A to Z.
std::string capitals(std::string_view text);
void append_capitals(std::string_view text, std::string& out);
/// The same without blanks: how Abaqus compares keywords, parameters and names.
std::string folded(std::string_view text);

/// A finite number in C, Fortran or Nastran notation (1.5, .5, +1, 1D3, 1.5-3, 1.+5), or an
/// integer; one that is too small for a double is 0. None for anything else.
std::optional<double> to_number(std::string_view text);
/// A 32-bit integer; none for anything else.
std::optional<int32_t> to_integer(std::string_view text);

/// `text` between quotes for messages: at most 40 characters, unprintable ones as '?'.
std::string shown(std::string_view text);

}  // namespace clatter::mesh::deck
