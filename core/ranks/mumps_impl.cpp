// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/error.hpp"
#include "core/ranks/index_places.hpp"
#include "core/ranks/mumps_impl.hpp"

namespace clatter::ranks {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// diag(K)^(-1/2) of the rank's rows rounded to powers of two; 1 where the diagonal is not
/// positive.
VectorXd scale_of(const Entries& K, const RowShares& shares, int rank, Index rows) {
  VectorXd scale = VectorXd::Ones(rows);
  for (const Entry& entry : K) {
    if (entry.row != entry.column || !(entry.value > 0.0)) continue;
    const int64_t row = shares.local(entry.row, rank);
    if (row < rows) scale[row] = std::exp2(-std::round(0.5 * std::log2(entry.value)));
  }
  return scale;
}

bool belongs(const Entry& entry, const RowShares& shares, Extent extent) {
  const bool row = entry.row < shares.interior(), column = entry.column < shares.interior();
  if (extent == Extent::kInterior) return row && column;
  return extent == Extent::kWhole || row || column;
}

}  // namespace

ScaledTriplets scaled_triplets(const Ranks& ranks, const RowShares& shares,
                               const ShiftedEntries& from, Extent extent) {
  const bool whole = extent == Extent::kWhole;
  const int self = ranks.rank();
  const auto own = static_cast<Index>(shares.rows_of(self, whole).size());
  ScaledTriplets out;
  out.scale = scale_of(from.K, shares, self, own);
  const auto each = [&](const auto& use) {
    for (const Entries* part : {&from.K, from.sigma != 0.0 ? &from.M : nullptr}) {
      if (part == nullptr) continue;
      const double factor = part == &from.K ? 1.0 : -from.sigma;
      for (const Entry& entry : *part)
        if (entry.column <= entry.row && belongs(entry, shares, extent)) use(entry, factor);
    }
  };
  IndexPlaces used(shares.size());
  size_t count = 0;
  each([&](const Entry& entry, double) {
    used.add(entry.column);
    ++count;
  });
  const std::vector<int64_t> columns = used.number();
  VectorXd all =
      VectorXd::Ones(static_cast<Index>(shares.rows_of(self, true).size()));  // boundary rows: 1
  all.head(own) = out.scale;
  VectorXd by_column(static_cast<Index>(columns.size()));
  RowExchange(ranks, shares, columns).fetch(all.data(), by_column.data(), 1);
  Triplets& triplets = out.triplets;
  triplets.rows.reserve(count);
  triplets.columns.reserve(count);
  triplets.values.reserve(count);
  each([&](const Entry& entry, double factor) {
    triplets.rows.push_back(entry.row + 1);
    triplets.columns.push_back(entry.column + 1);
    triplets.values.push_back(factor * entry.value * all[shares.local(entry.row, self)] *
                              by_column[used[entry.column]]);
  });
  return out;
}

void fail(MumpsInstance& mumps, const std::string& what) {
  const MUMPS_INT code = mumps.infog(1), detail = mumps.infog(2);
  mumps.end();
  switch (code) {
    case -10:
    case -40:
      throw sparse::NotPositiveDefinite("matrix is singular to working precision", -1);
    case -7:
    case -8:
    case -9:
    case -13:
    case -19:
      throw NumericsError(
          fmt::format("out of memory in the {} (MUMPS {}, {}): use more ranks, or fewer on a node",
                      what, code, detail));
    case -90:
      throw FileError(fmt::format(
          "the {} could not write its factor to disk (MUMPS {}, {}): free space in TMPDIR", what,
          code, detail));
    default:
      throw NumericsError(fmt::format("the {} failed (MUMPS {}, {})", what, code, detail));
  }
}

void factorise(MumpsInstance& mumps, const std::string& what) {
  constexpr MUMPS_INT kRelaxation[] = {30, 60, 120, 240, 480};  // [%]
  for (const MUMPS_INT percent : kRelaxation) {
    mumps.icntl(14) = percent;
    mumps.run(kFactorise);
    if (mumps.infog(1) >= 0) return;
    if (mumps.infog(1) != -8 && mumps.infog(1) != -9) break;
  }
  fail(mumps, what);
}

void require_schur_counts(MumpsInstance& mumps, int64_t boundary) {
  constexpr int64_t kMost = 46340;  // its square is the last below 2^31
  if (boundary <= kMost) return;
  mumps.end();
  throw NumericsError(
      fmt::format("found {} boundary coordinates, expected at most {} with several ranks: their "
                  "Schur complement has 2^31 entries or more",
                  boundary, kMost));
}

void give_matrix(MumpsInstance& mumps, Triplets& triplets, std::vector<MUMPS_INT>& order,
                 int64_t size) {
  if (size >= std::numeric_limits<MUMPS_INT>::max()) {
    mumps.end();
    throw NumericsError(fmt::format("found {} unknowns, expected fewer than 2^31", size));
  }
  DMUMPS_STRUC_C& data = mumps.data();
  data.n = static_cast<MUMPS_INT>(size);
  data.nnz_loc = static_cast<MUMPS_INT8>(triplets.values.size());
  data.irn_loc = triplets.rows.data();
  data.jcn_loc = triplets.columns.data();
  data.a_loc = triplets.values.data();
  order.resize(size);
  std::iota(order.begin(), order.end(), 1);
  data.perm_in = order.data();
}

}  // namespace clatter::ranks
