// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cards that repeat the one before them:
//
//   GRID,  11, , 0., 0., 5.
//   =,     12, =, *(1.), ==       the same card: =  the same field, *(d) that field plus d,
//                                 ==  the same fields up to the end
//   =3                            three more, each with the same steps from the one before
#include <string>
#include <string_view>
#include <vector>

#include "mesh/deck/nastran/fields.hpp"

namespace clatter::mesh::deck::nastran {

class Replication {
 public:
  /// Remembers the first line of a card.
  void remember(std::string_view line) { previous_ = line; }
  static bool is_replication(const LineFields& line) {
    return !line.continuation && line.head.starts_with('=');
  }
  /// The lines, in free fields, for which `line` stands. `trouble` is why it stands for none.
  std::vector<std::string> expand(const LineFields& line, std::string& trouble);

 private:
  std::string next_line(std::string& trouble) const;

  std::string previous_;
  std::vector<std::string> steps_;  // fields of the last line with =, without its first
};

}  // namespace clatter::mesh::deck::nastran
