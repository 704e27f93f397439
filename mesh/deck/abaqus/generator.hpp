// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the keywords that generate nodes and those that generate elements share.
#include <limits>

#include "mesh/deck/abaqus/generate.hpp"

namespace clatter::mesh::deck::abaqus {

inline constexpr int32_t kMostNumber = std::numeric_limits<int32_t>::max();
inline constexpr size_t kMostMade = size_t{1} << 24;  // of one keyword: half a gigabyte

/// One card, with the scope that gets what it makes.
class Generator {
 public:
  Generator(const Card& card, Scope& scope, const Source& source, Ignore& ignore)
      : card_(card), keyword_(card.keyword()), scope_(scope), source_(source), ignore_(ignore) {}

 protected:
  /// A number of a new node or element.
  int32_t number(int64_t id, Origin origin) const;
  /// The set that the parameter names, if there is one, gets what was made and `more`.
  void name_set(std::string_view parameter, IdSets& sets, std::vector<int32_t> more);
  std::vector<int32_t> set(const IdSets& sets, const std::string& name) const;
  /// An integer that a parameter of the keyword gives.
  int32_t parameter(std::string_view name) const;

  const Card& card_;
  const Keyword& keyword_;
  Scope& scope_;
  const Source& source_;
  Ignore& ignore_;
  std::vector<int32_t> made_;  // numbers
};

/// *NGEN, *NFILL, *NCOPY.
void generate_nodes(const Card& card, Scope& scope, const LocalSystem& system, const Source& source,
                    Ignore& ignore);
/// *NMAP; InputError for mappings that are not linear, cylindrical or spherical.
void map_nodes(const Card& card, Scope& scope, const Source& source, Ignore& ignore);
/// *ELGEN, *ELCOPY.
void generate_elements(const Card& card, Scope& scope, const Source& source, Ignore& ignore);

}  // namespace clatter::mesh::deck::abaqus
