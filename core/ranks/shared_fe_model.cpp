// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ranks/shared_fe_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/h5_slab.hpp"
#include "core/fe/stored_pattern.hpp"
#include "core/sparse/factor/ordering.hpp"

namespace clatter::ranks {
namespace {

[[noreturn]] void refuse_matrix(const std::filesystem::path& path, const std::string& group,
                                const std::string& what) {
  throw InputError(fmt::format("{}: {}: {}", path.string(), group, what));
}

/// A symmetric positive semidefinite matrix has no negative diagonal entry; where one is zero, the
/// column is zero.
void check_diagonal(const std::filesystem::path& path, const std::string& group,
                    const fe::StoredColumns& columns, const std::vector<double>& values) {
  for (size_t c = 0; c + 1 < columns.starts.size(); ++c) {
    const auto begin = static_cast<size_t>(columns.starts[c]);
    const auto end = static_cast<size_t>(columns.starts[c + 1]);
    const int64_t column = columns.first + static_cast<int64_t>(c);
    if (begin == end) continue;
    if (columns.rows[begin] != column)
      refuse_matrix(path, fmt::format("{}, column {}", group, column),
                    "found a column that does not start on the diagonal, expected the lower "
                    "triangle");
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = values.begin() + static_cast<std::ptrdiff_t>(end);
    const bool alone = std::all_of(first + 1, last, [](double value) { return value == 0.0; });
    if (!std::all_of(first, last, [](double value) { return std::isfinite(value); }))
      refuse_matrix(path, group, fmt::format("column {} holds a value that is not finite", column));
    if (!(*first > 0.0 || (*first == 0.0 && alone)))
      refuse_matrix(path, fmt::format("{}, column {}", group, column),
                    fmt::format("found diagonal {:g}, expected a positive number, or an empty "
                                "column",
                                *first));
  }
}

/// The entries of all parts by row, then by column: counted by row, since only rows are short
/// enough to be sorted in cache.
Entries sorted(const std::vector<Entries>& parts, const RowShares& shares, int rank) {
  std::vector<int64_t> next(shares.rows_of(rank, true).size() + 1, 0);
  const auto row_of = [&](const Entry& entry) {
    return static_cast<size_t>(shares.local(entry.row, rank));
  };
  for (const Entries& part : parts)
    for (const Entry& entry : part) ++next[row_of(entry) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  Entries own(static_cast<size_t>(next.back()));
  for (const Entries& part : parts)
    for (const Entry& entry : part) own[next[row_of(entry)]++] = entry;
  int64_t begin = 0;
  for (size_t row = 0; row + 1 < next.size(); ++row) {
    std::sort(own.begin() + begin, own.begin() + next[row],
              [](const Entry& a, const Entry& b) { return a.column < b.column; });
    begin = next[row];
  }
  return own;
}

Entries read_entries(const Ranks& ranks, const std::filesystem::path& path,
                     const std::string& group, const Numbering& numbering,
                     const RowShares& shares) {
  const int64_t n = shares.size();
  const int64_t first = n * ranks.rank() / ranks.size();
  const int64_t count = n * (ranks.rank() + 1) / ranks.size() - first;
  const fe::StoredColumns columns = fe::read_columns(path, group, n, first, count);
  const int64_t offset =
      count > 0 ? read_part_of_ints(path, group + "/indptr", first, 1).front() : 0;
  const auto values = read_part_of_doubles(path, group + "/data", offset, columns.starts.back());
  check_diagonal(path, group, columns, values);
  std::vector<Entries> out(static_cast<size_t>(ranks.size()));
  const auto send = [&](int32_t row, int32_t column, double value) {
    out[shares.owner(row)].push_back({row, column, value});
  };
  for (int64_t c = 0; c < count; ++c) {
    const int32_t j = numbering.index[first + c];
    for (int64_t k = columns.starts[c]; k < columns.starts[static_cast<size_t>(c) + 1]; ++k) {
      const int32_t i = numbering.index[columns.rows[k]];
      send(i, j, values[k]);
      if (i != j) send(j, i, values[k]);
    }
  }
  return sorted(ranks.exchange(out), shares, ranks.rank());
}

/// Nested dissection of the interior, computed by rank 0, which reads the pattern of K for it; or
/// `known`, where it fits.
Numbering number_dofs(const Ranks& ranks, const std::filesystem::path& path,
                      const std::vector<int32_t>& interior, const std::vector<int32_t>& boundary,
                      const rom::EliminationOrder& known) {
  Numbering out;
  if (ranks.rank() == 0) {
    const SparseMatrix pattern = fe::read_stiffness_pattern(path, interior, boundary).ii;
    out.stored = known;
    out.stored.method = "given";
    if (!known.fits(pattern)) {
      const sparse::FillOrder found =
          sparse::fill_reducing_order(pattern, sparse::Ordering::kMetis);
      out.stored = {found.order, rom::sha256_of_pattern(pattern),
                    sparse::ordering_name(found.method), 0};
    }
  }
  ranks.share(out.stored.permutation);
  out.stored.pattern = ranks.share(out.stored.pattern);
  out.stored.method = ranks.share(out.stored.method);
  for (const int32_t row : out.stored.permutation) out.dof.push_back(interior[row]);
  out.dof.insert(out.dof.end(), boundary.begin(), boundary.end());
  out.index.resize(out.dof.size());
  for (size_t k = 0; k < out.dof.size(); ++k) out.index[out.dof[k]] = static_cast<int32_t>(k);
  return out;
}

}  // namespace

SharedMatrices::SharedMatrices(const Ranks& all, const std::filesystem::path& path,
                               const std::vector<int32_t>& interior,
                               const std::vector<int32_t>& boundary,
                               const rom::EliminationOrder& known)
    : ranks(all),
      numbering(number_dofs(all, path, interior, boundary, known)),
      shares(static_cast<int64_t>(interior.size()), static_cast<int64_t>(boundary.size()),
             all.size()),
      K(read_entries(all, path, "K", numbering, shares)),
      M(read_entries(all, path, "M", numbering, shares)) {}

}  // namespace clatter::ranks
