// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ranks/shared_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/matrix.hpp"
#include "core/base/threads.hpp"
#include "core/ranks/index_places.hpp"

namespace clatter::ranks {

using Eigen::Index;
using Eigen::MatrixXd;

SharedMatrix::SharedMatrix(const Ranks& ranks, const RowShares& shares, const Entries& entries,
                           bool with_boundary) {
  const int self = ranks.rank();
  const auto each = [&](const auto& use) {
    for (const Entry& entry : entries)
      if (with_boundary || (entry.row < shares.interior() && entry.column < shares.interior()))
        use(entry, shares.owns(self, entry.column));
  };
  rows_ = static_cast<Index>(shares.rows_of(self, with_boundary).size());
  IndexPlaces fetched(shares.size());
  starts_.assign(static_cast<size_t>(rows_) + 1, 0);
  each([&](const Entry& entry, bool here) {
    ++starts_[static_cast<size_t>(shares.local(entry.row, self)) + 1];
    if (!here) fetched.add(entry.column);
  });
  const std::vector<int64_t> others = fetched.number();
  for (size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
  columns_.reserve(starts_.back());
  values_.reserve(columns_.capacity());
  diagonal_ = Eigen::VectorXd::Zero(rows_);
  each([&](const Entry& entry, bool here) {
    columns_.push_back(static_cast<int32_t>(here ? shares.local(entry.column, self)
                                                 : rows_ + fetched[entry.column]));
    values_.push_back(entry.value);
    if (entry.row == entry.column) diagonal_[columns_.back()] = entry.value;
  });
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
      for (int64_t k = starts_[i]; k < starts_[static_cast<size_t>(i) + 1]; ++k) {
        const int64_t column = columns_[k];
        const double* in =
            column < rows_ ? x + column * count : remote.data() + (column - rows_) * count;
        const double value = of(values_[k]);
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
