// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rom/elimination_order.hpp"

#include "core/base/artefact.hpp"

namespace clatter::rom {
namespace {

bool is_permutation(const std::vector<int32_t>& order) {
  std::vector<char> seen(order.size(), 0);
  for (const int32_t unknown : order) {
    if (unknown < 0 || static_cast<size_t>(unknown) >= order.size()) return false;
    char& once = seen[unknown];
    if (once != 0) return false;
    once = 1;
  }
  return true;
}

template <class Index>
std::string_view bytes_of(const Index* values, int64_t count) {
  return {reinterpret_cast<const char*>(values), static_cast<size_t>(count) * sizeof(Index)};
}

}  // namespace

bool EliminationOrder::fits(const SparseMatrix& lower) const {
  return permutation.size() == static_cast<size_t>(lower.cols()) &&
         pattern == sha256_of_pattern(lower);
}

std::string sha256_of_pattern(const SparseMatrix& lower) {
  return sha256_of_bytes({bytes_of(lower.outerIndexPtr(), lower.cols() + 1),
                          bytes_of(lower.innerIndexPtr(), lower.nonZeros())});
}

void write_elimination_order(H5File& file, const EliminationOrder& order) {
  if (order.permutation.empty()) return;
  file.write("ordering/permutation", order.permutation);
  file.set("ordering", "pattern_sha256", order.pattern);
  file.set("ordering", "method", order.method);
  file.set("ordering", "factor_entries", order.entries);
}

EliminationOrder read_elimination_order(const std::filesystem::path& path) {
  EliminationOrder order;
  if (!std::filesystem::exists(path)) return order;
  try {
    const H5File file = H5File::open(path);
    if (!file.has("ordering/permutation")) return order;
    order.permutation = file.read_ints("ordering/permutation");
    order.pattern = file.get_string("ordering", "pattern_sha256");
    order.method = file.get_string("ordering", "method");
    order.entries = file.get_int("ordering", "factor_entries");
  } catch (const std::runtime_error&) {
    return {};
  }
  return is_permutation(order.permutation) ? order : EliminationOrder{};
}

}  // namespace clatter::rom
