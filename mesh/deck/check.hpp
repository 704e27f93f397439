// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// `clatter-mesh --check deck`: all that a deck holds, in one table.
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/json_line.hpp"
#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// A row of the table.
struct CheckedRow {
  int64_t count = 0;
  std::string kind, name;  // "card", "CHEXA"; empty for messages
  std::string fate;        // read, passed over, ignored, refused, renumbered, noted
  std::string where;       // "deck.bdf:12", the first position; empty where there is none
  std::string remark;      // what it becomes, what the reader says, or what to write instead
};

struct CheckedDeck {
  std::vector<CheckedRow> rows;
  int64_t refused = 0;  // rows
  std::string summary;  // nodes, cells and more of a deck that is read; else empty
};

/// Reads the deck as read_deck() does, with the same proofs, and lists what became of each card,
/// keyword, element type and command; then what the reader says about the deck; then what it
/// refuses, up to a thousand messages. FileError when the deck cannot be read.
CheckedDeck check_deck(const std::filesystem::path& path, const std::vector<std::string>& ignore);

/// The table as lines of text, with its head.
std::vector<std::string> table_of(const CheckedDeck& checked);

/// For --json: rows, a list of objects with the members of CheckedRow, and refused, their number.
JsonMembers json_of(const CheckedDeck& checked);

}  // namespace clatter::mesh::deck
