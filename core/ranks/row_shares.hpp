// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Which rank has which rows, and the exchange of rows between ranks.
#include <cstdint>
#include <vector>

#include "core/ranks/ranks.hpp"

namespace clatter::ranks {

/// Indices 0 .. n-1 in elimination order, the n_b boundary ones last. Each rank has a contiguous
/// part of the interior, which nested dissection makes compact in space, and one of the boundary.
class RowShares {
 public:
  RowShares(int64_t interior, int64_t boundary, int ranks);
  int64_t size() const { return interior_ + boundary_; }
  int64_t interior() const { return interior_; }
  int64_t boundary() const { return boundary_; }
  int ranks() const { return ranks_; }
  int owner(int64_t index) const;
  bool owns(int rank, int64_t index) const {
    const Starts& starts = index < interior_ ? interior_starts_ : boundary_starts_;
    const int64_t at = index < interior_ ? index : index - interior_;
    return starts[rank] <= at && at < starts[static_cast<size_t>(rank) + 1];
  }
  /// The indices of a rank: its interior ones, then its boundary ones, ascending.
  std::vector<int64_t> rows_of(int rank, bool with_boundary) const;
  /// The row of an index on its owner.
  int64_t local(int64_t index) const { return local(index, owner(index)); }
  /// The same, with the owner known.
  int64_t local(int64_t index, int owner) const {
    const auto r = static_cast<size_t>(owner);
    if (index < interior_) return index - interior_starts_[r];
    return interior_starts_[r + 1] - interior_starts_[r] + index - interior_ - boundary_starts_[r];
  }

 private:
  using Starts = std::vector<int64_t>;
  int64_t interior_, boundary_;
  int ranks_;
  Starts interior_starts_, boundary_starts_;  // first row of each rank, and their end
};

/// Moves rows from their owners to where they are needed.
class RowExchange {
 public:
  /// @param wanted indices whose values this rank needs, each any number of times.
  RowExchange(const Ranks& ranks, const RowShares& shares, const std::vector<int64_t>& wanted);
  /// y: row k is row wanted[k]; x and y row-major with `count` values a row. Collective.
  void fetch(const double* x, double* y, int count) const;
  /// The reverse: row wanted[k] of x, on its owner, is row k of y.
  void deliver(const double* y, double* x, int count) const;

 private:
  const Ranks& ranks_;
  std::vector<std::vector<int64_t>> mine_;    // by rank: own rows that it wants
  std::vector<std::vector<int64_t>> places_;  // by rank: rows of y that come from it
};

}  // namespace clatter::ranks
