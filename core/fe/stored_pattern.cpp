// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/stored_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/h5_slab.hpp"

namespace clatter::fe {

using Eigen::Index;

StoredColumns read_columns(const std::filesystem::path& path, const std::string& group, int64_t n,
                           int64_t first, int64_t count) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}: {}", path.string(), group, what));
  };
  const auto indptr = read_part_of_ints(path, group + "/indptr", first, count + 1);
  StoredColumns out;
  out.first = first;
  if (!std::is_sorted(indptr.begin(), indptr.end()) || indptr.front() < 0)
    refuse("indptr falls, expected ascending offsets");
  for (const int32_t at : indptr) out.starts.push_back(int64_t{at} - indptr.front());
  out.rows = read_part_of_ints(path, group + "/indices", indptr.front(), out.starts.back());
  for (int64_t c = 0; c < count; ++c) {
    int64_t above = first + c - 1;
    for (int64_t k = out.starts[c]; k < out.starts[static_cast<size_t>(c) + 1]; ++k) {
      const int32_t row = out.rows[k];
      if (row <= above || row >= n)
        refuse(fmt::format("column {} has row index {}, expected ascending within {} to {}",
                           first + c, row, first + c, n - 1));
      above = row;
    }
  }
  return out;
}

StiffnessPattern read_stiffness_pattern(const std::filesystem::path& path,
                                        const std::vector<int32_t>& interior,
                                        const std::vector<int32_t>& boundary) {
  const auto n = static_cast<int64_t>(interior.size() + boundary.size());
  const StoredColumns K = read_columns(path, "K", n, 0, n);
  // Row in the interior, or -1 - column of the boundary.
  std::vector<int32_t> place(static_cast<size_t>(n), 0);
  for (size_t k = 0; k < interior.size(); ++k) place[interior[k]] = static_cast<int32_t>(k);
  for (size_t k = 0; k < boundary.size(); ++k) place[boundary[k]] = -1 - static_cast<int32_t>(k);
  const auto each = [&](int64_t column, const auto& use) {
    for (int64_t k = K.starts[column]; k < K.starts[static_cast<size_t>(column) + 1]; ++k)
      use(place[K.rows[k]]);
  };
  StiffnessPattern out;
  const auto n_i = static_cast<Index>(interior.size());
  out.ii.resize(n_i, n_i);
  int32_t* const starts = out.ii.outerIndexPtr();
  for (Index k = 0; k < n_i; ++k) {
    int32_t count = 0;
    each(interior[k], [&](int32_t row) { count += row >= 0 ? 1 : 0; });
    starts[k + 1] = starts[k] + count;
  }
  out.ii.resizeNonZeros(starts[n_i]);
  int32_t* row_of = out.ii.innerIndexPtr();
  for (const int32_t column : interior)
    each(column, [&](int32_t row) {
      if (row >= 0) *row_of++ = row;
    });
  std::fill_n(out.ii.valuePtr(), out.ii.nonZeros(), 0.0);
  std::vector<Eigen::Triplet<double>> coupling;
  for (int64_t column = 0; column < n; ++column) {
    const int32_t here = place[column];
    each(column, [&](int32_t row) {
      if ((here < 0) != (row < 0))
        coupling.emplace_back(std::max(here, row), -1 - std::min(here, row), 0.0);
    });
  }
  out.ib.resize(n_i, static_cast<Index>(boundary.size()));
  out.ib.setFromTriplets(coupling.begin(), coupling.end());
  return out;
}

}  // namespace clatter::fe
