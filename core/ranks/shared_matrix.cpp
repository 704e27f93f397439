// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ranks/shared_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/matrix.hpp"
#include "core/base/threads.hpp"

namespace clatter::ranks {

using Eigen::Index;
using Eigen::MatrixXd;

SharedMatrix::SharedMatrix(const Ranks& ranks, const RowShares& shares, const Entries& entries,
                           bool with_boundary) {
  const auto belongs = [&](int64_t index) { return with_boundary || index < shares.interior(); };
  rows_ = static_cast<Index>(shares.rows_of(ranks.rank(), with_boundary).size());
  std::vector<int64_t> others;
  starts_.assign(static_cast<size_t>(rows_) + 1, 0);
  for (const Entry& entry : entries) {
    if (!belongs(entry.row) || !belongs(entry.column)) continue;
    ++starts_[static_cast<size_t>(shares.local(entry.row)) + 1];
    if (shares.owner(entry.column) != ranks.rank()) others.push_back(entry.column);
  }
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  for (size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
  columns_.reserve(static_cast<size_t>(starts_.back()));
  values_.reserve(columns_.capacity());
  diagonal_ = Eigen::VectorXd::Zero(rows_);
  for (const Entry& entry : entries) {
    if (!belongs(entry.row) || !belongs(entry.column)) continue;
    const auto own = static_cast<int32_t>(shares.local(entry.column));
    const auto place = std::lower_bound(others.begin(), others.end(), entry.column);
    const bool here = shares.owner(entry.column) == ranks.rank();
    columns_.push_back(here ? own : static_cast<int32_t>(rows_ + (place - others.begin())));
    values_.push_back(entry.value);
    if (entry.row == entry.column) diagonal_[own] = entry.value;
  }
  fetched_ = static_cast<int64_t>(others.size());
  others_ = std::make_unique<RowExchange>(ranks, shares, others);
}

/// With of(value) as the entries.
template <class Of>
void SharedMatrix::multiply_with(Of&& of, const double* x, double* y, int count) const {
  std::vector<double> remote(static_cast<size_t>(fetched_ * count));
  others_->fetch(x, remote.data(), count);
  parallel_pieces(rows_, [&](int64_t begin, int64_t end) {
    for (int64_t i = begin; i < end; ++i) {
      double* out = y + i * count;
      std::fill_n(out, count, 0.0);
      for (int64_t k = starts_[static_cast<size_t>(i)]; k < starts_[static_cast<size_t>(i) + 1];
           ++k) {
        const int64_t column = columns_[static_cast<size_t>(k)];
        const double* in =
            column < rows_ ? x + column * count : remote.data() + (column - rows_) * count;
        const double value = of(values_[static_cast<size_t>(k)]);
        for (int c = 0; c < count; ++c) out[c] += value * in[c];
      }
    }
  });
}

void SharedMatrix::multiply(const double* x, double* y, int count) const {
  multiply_with([](double value) { return value; }, x, y, count);
}

MatrixXd SharedMatrix::operator*(const Eigen::Ref<const MatrixXd>& x) const {
  const RowMatrix from = x;
  RowMatrix to(rows_, x.cols());
  multiply(from.data(), to.data(), static_cast<int>(x.cols()));
  return to;
}

MatrixXd SharedMatrix::magnitude_times(const MatrixXd& x) const {
  const RowMatrix from = x.cwiseAbs();
  RowMatrix to(rows_, x.cols());
  multiply_with([](double value) { return std::abs(value); }, from.data(), to.data(),
                static_cast<int>(x.cols()));
  return to;
}

}  // namespace clatter::ranks
