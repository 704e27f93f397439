// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One physical line of bulk data split into its fields.
//
//   small   name of 8 columns, 8 data fields of 8, continuation name in columns 73 to 80
//   large   the same with 4 data fields of 16: the name ends, or a continuation begins, with *
//   free fields between commas, 8 (large: 4) and the continuation name; text after the continuation
//   name is the next line of the card
//
// Tabs are blanks up to the next column of eight. Comments ($) end a line.
#include <string>
#include <string_view>
#include <vector>

namespace clatter::mesh::deck::nastran {

/// Views into the line that was split, or into `expanded`.
struct LineFields {
  std::string_view head;  // card name without *; of a continuation: its name without + or *
  bool continuation = false;
  bool large = false;
  std::vector<std::string_view> data;  // trimmed; 8 or 4 for each line of the card
  std::string_view next;               // name of the continuation, without + or *; often empty
  std::string expanded;                // the line without tabs, if it had any
};

/// Splits `line` (neither blank nor a comment). Returns the error, empty for none.
std::string split_line(std::string_view line, LineFields& out);

/// The line without its comment ($) and trailing blanks.
std::string_view without_comment(std::string_view line);

}  // namespace clatter::mesh::deck::nastran
