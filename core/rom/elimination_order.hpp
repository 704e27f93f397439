#pragma once
// The order in which a matrix was factorised, kept in an artefact: it is found once and used again.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/base/sparse.hpp"

namespace clatter::rom {

struct EliminationOrder {
  std::vector<int32_t> permutation;  // unknown that is eliminated at each place; empty: not known
  std::string pattern;               // sha256_of_pattern of the matrix it was found for
  std::string method;                // "metis", "amd", "natural", or "given" for one used again
  int64_t entries = 0;               // of the factor

  bool fits(const SparseMatrix& lower) const;
};

/// Hash of the places of a matrix's entries, not of their values.
std::string sha256_of_pattern(const SparseMatrix& lower);

/// Writes group `ordering`; nothing for an empty one.
void write_elimination_order(H5File& file, const EliminationOrder& order);

/// Reads it from an artefact. Empty when there is no such file, when it holds none, or when what it
/// holds is no permutation: an order only saves time, and nothing is lost without it.
EliminationOrder read_elimination_order(const std::filesystem::path& path);

}  // namespace clatter::rom
