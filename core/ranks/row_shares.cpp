// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ranks/row_shares.hpp"

#include <algorithm>

namespace clatter::ranks {
namespace {

using Rows = std::vector<std::vector<int64_t>>;

/// The rows `from[r]` of `values` for each rank r.
std::vector<std::vector<double>> packed(const Rows& from, const double* values, int count) {
  std::vector<std::vector<double>> out(from.size());
  for (size_t r = 0; r < from.size(); ++r) {
    out[r].resize(from[r].size() * static_cast<size_t>(count));
    for (size_t k = 0; k < from[r].size(); ++k)
      std::copy_n(values + from[r][k] * count, count,
                  out[r].data() + k * static_cast<size_t>(count));
  }
  return out;
}

/// Moves rows `from` of x to rows `to` of y; both are listed by the other rank.
void move_rows(const Ranks& ranks, const Rows& from, const Rows& to, const double* x, double* y,
               int count) {
  std::vector<std::vector<double>> in(to.size());
  for (size_t r = 0; r < to.size(); ++r) in[r].resize(to[r].size() * static_cast<size_t>(count));
  ranks.transfer(packed(from, x, count), in);
  for (size_t r = 0; r < to.size(); ++r)
    for (size_t k = 0; k < to[r].size(); ++k)
      std::copy_n(in[r].data() + k * static_cast<size_t>(count), count, y + to[r][k] * count);
}

}  // namespace

RowShares::RowShares(int64_t interior, int64_t boundary, int ranks)
    : interior_(interior), boundary_(boundary), ranks_(ranks) {
  for (int r = 0; r <= ranks; ++r) {
    interior_starts_.push_back(interior * r / ranks);
    boundary_starts_.push_back(boundary * r / ranks);
  }
}

int RowShares::owner(int64_t index) const {
  const bool inside = index < interior_;
  const Starts& starts = inside ? interior_starts_ : boundary_starts_;
  const int64_t size = inside ? interior_ : boundary_, at = inside ? index : index - interior_;
  auto rank = static_cast<size_t>(at * ranks_ / size);
  while (starts[rank] > at) --rank;
  while (starts[rank + 1] <= at) ++rank;
  return static_cast<int>(rank);
}

std::vector<int64_t> RowShares::rows_of(int rank, bool with_boundary) const {
  const auto r = static_cast<size_t>(rank);
  std::vector<int64_t> rows;
  for (int64_t i = interior_starts_[r]; i < interior_starts_[r + 1]; ++i) rows.push_back(i);
  for (int64_t b = boundary_starts_[r]; with_boundary && b < boundary_starts_[r + 1]; ++b)
    rows.push_back(interior_ + b);
  return rows;
}

RowExchange::RowExchange(const Ranks& ranks, const RowShares& shares,
                         const std::vector<int64_t>& wanted)
    : ranks_(ranks), places_(static_cast<size_t>(ranks.size())) {
  Rows requested(places_.size());
  for (size_t k = 0; k < wanted.size(); ++k) {
    const auto owner = static_cast<size_t>(shares.owner(wanted[k]));
    requested[owner].push_back(shares.local(wanted[k]));
    places_[owner].push_back(static_cast<int64_t>(k));
  }
  mine_ = ranks.exchange(requested);
}

void RowExchange::fetch(const double* x, double* y, int count) const {
  move_rows(ranks_, mine_, places_, x, y, count);
}

void RowExchange::deliver(const double* y, double* x, int count) const {
  move_rows(ranks_, places_, mine_, y, x, count);
}

}  // namespace clatter::ranks
