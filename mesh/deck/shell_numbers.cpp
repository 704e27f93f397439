// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/shell_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unordered_set>

#include "core/base/error.hpp"

namespace clatter::mesh::deck {

std::vector<std::vector<int32_t>> shell_numbers(const Mesh& mesh,
                                                const std::vector<std::vector<int32_t>>& solids) {
  if (mesh.shells.empty()) return {};
  std::unordered_set<int32_t> taken;
  int32_t last = 0;
  for (const std::vector<int32_t>& numbers : solids) taken.insert(numbers.begin(), numbers.end());
  for (const int32_t number : taken) last = std::max(last, number);
  for (const ShellBlock& block : mesh.shells)
    for (const int32_t id : block.ids) last = std::max(last, id);
  std::vector<std::vector<int32_t>> all;
  for (const ShellBlock& block : mesh.shells) {
    std::vector<int32_t>& numbers = all.emplace_back(block.ids);
    numbers.resize(static_cast<size_t>(block.nodes.rows()), 0);
    for (int32_t& number : numbers) {
      if (number > 0 && taken.insert(number).second) continue;
      if (last == std::numeric_limits<int32_t>::max())
        throw InputError(fmt::format("mesh '{}': found no free numbers for shells", mesh.name));
      number = ++last;
    }
  }
  return all;
}

}  // namespace clatter::mesh::deck
