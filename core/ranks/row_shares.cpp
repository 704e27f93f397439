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
    : interior_(interior), boundary_(boundary), ranks_(ranks) {}

int RowShares::owner(int64_t index) const {
  const bool inside = index < interior_;
  const int64_t size = inside ? interior_ : boundary_, at = inside ? index : index - interior_;
  int rank = static_cast<int>(at * ranks_ / size);
  while (first(size, rank, ranks_) > at) --rank;
  while (first(size, rank + 1, ranks_) <= at) ++rank;
  return rank;
}

int64_t RowShares::local(int64_t index) const {
  const int rank = owner(index);
  const int64_t begin = first(interior_, rank, ranks_);
  if (index < interior_) return index - begin;
  return first(interior_, rank + 1, ranks_) - begin + index - interior_ -
         first(boundary_, rank, ranks_);
}

std::vector<int64_t> RowShares::rows_of(int rank, bool with_boundary) const {
  std::vector<int64_t> rows;
  for (int64_t i = first(interior_, rank, ranks_); i < first(interior_, rank + 1, ranks_); ++i)
    rows.push_back(i);
  for (int64_t b = first(boundary_, rank, ranks_);
       with_boundary && b < first(boundary_, rank + 1, ranks_); ++b)
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
