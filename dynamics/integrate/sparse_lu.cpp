// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/sparse_lu.hpp"

#include <fmt/format.h>
#include <suitesparse/klu.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {

namespace {

/// Reciprocal growth below which kept pivots are given up: it loses half of the digits.
constexpr double kLeastGrowth = 1e-8;

}  // namespace

struct SparseLu::Impl {
  std::vector<int> starts, rows;
  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;

  Impl(std::vector<int> column_starts, std::vector<int> row_indices)
      : starts(std::move(column_starts)), rows(std::move(row_indices)) {
    klu_defaults(&common);
    symbolic = klu_analyze(size(), starts.data(), rows.data(), &common);
    if (symbolic == nullptr)
      throw NumericsError(fmt::format(
          "analysis of a sparse matrix of {} rows failed: KLU status {}", size(), common.status));
  }
  ~Impl() {
    forget();
    klu_free_symbolic(&symbolic, &common);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  int size() const { return static_cast<int>(starts.size()) - 1; }
  void forget() {
    if (numeric != nullptr) klu_free_numeric(&numeric, &common);
  }

  bool refactor(std::vector<double>& values) {
    if (klu_refactor(starts.data(), rows.data(), values.data(), symbolic, numeric, &common) == 0)
      return false;
    if (common.status != KLU_OK) return false;
    klu_rgrowth(starts.data(), rows.data(), values.data(), symbolic, numeric, &common);
    return common.rgrowth > kLeastGrowth;
  }
};

SparseLu::SparseLu(std::vector<int> starts, std::vector<int> rows)
    : impl_(std::make_unique<Impl>(std::move(starts), std::move(rows))) {}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

int SparseLu::size() const { return impl_->size(); }
int SparseLu::nonzeros() const { return impl_->starts.back(); }

int SparseLu::factor_nonzeros() const {
  return impl_->numeric == nullptr
             ? 0
             : impl_->numeric->lnz + impl_->numeric->unz + impl_->numeric->nzoff;
}

bool SparseLu::factor(std::vector<double>& values) {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(values.begin(), values.end(), finite)) return false;
  if (impl_->numeric != nullptr && impl_->refactor(values)) return true;
  impl_->forget();
  impl_->numeric = klu_factor(impl_->starts.data(), impl_->rows.data(), values.data(),
                              impl_->symbolic, &impl_->common);
  return impl_->numeric != nullptr && impl_->common.status == KLU_OK;
}

void SparseLu::solve(double* x) const {
  klu_solve(impl_->symbolic, impl_->numeric, size(), 1, x, &impl_->common);
}

}  // namespace clatter::dynamics
