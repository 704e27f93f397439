// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/cholmod_analysis.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"

namespace clatter::sparse {
namespace {

/// CHOLMOD's settings and workspace; messages are off because we report errors ourselves.
class Common {
 public:
  explicit Common(bool merged) {
    cholmod_l_start(&data_);
    data_.print = 0;
    data_.error_handler = nullptr;
    data_.supernodal = CHOLMOD_SUPERNODAL;
    data_.nmethods = 1;
    data_.method[0].ordering = CHOLMOD_GIVEN;
    // Larger blocks than CHOLMOD's own choice: our fronts and sweeps rely on BLAS-3.
    data_.nrelax[0] = merged ? 8 : 0;
    data_.nrelax[1] = merged ? 32 : 0;
    data_.nrelax[2] = merged ? 96 : 0;
    if (!merged) std::fill_n(data_.zrelax, 3, 0.0);
  }
  ~Common() { cholmod_l_finish(&data_); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;
  cholmod_common* get() { return &data_; }
  cholmod_common* operator->() { return &data_; }

 private:
  cholmod_common data_;
};

/// The pattern in CHOLMOD's format: long indices, lower triangle.
struct LongPattern {
  std::vector<SuiteSparse_long> starts, rows;
  cholmod_sparse view{};

  explicit LongPattern(const SparseMatrix& lower) {
    const auto n = static_cast<size_t>(lower.cols());
    starts.assign(n + 1, 0);
    rows.reserve(lower.nonZeros());
    for (int j = 0; j < lower.cols(); ++j) {
      for (SparseMatrix::InnerIterator it(lower, j); it; ++it)
        if (it.row() >= j) rows.push_back(it.row());
      starts[static_cast<size_t>(j) + 1] = static_cast<SuiteSparse_long>(rows.size());
    }
    view.nrow = view.ncol = n;
    view.nzmax = rows.size();
    view.p = starts.data();
    view.i = rows.data();
    view.stype = -1;
    view.itype = CHOLMOD_LONG;
    view.xtype = CHOLMOD_PATTERN;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
  }
};

[[noreturn]] void fail_for_status(int status) {
  if (status == CHOLMOD_OUT_OF_MEMORY)
    throw NumericsError("out of memory while ordering the matrix");
  if (status == CHOLMOD_TOO_LARGE) throw NumericsError("the matrix is too large while ordering it");
  throw NumericsError(fmt::format("CHOLMOD failed with status {} while ordering", status));
}

/// Fills the parts that depend only on the eliminated unknowns.
void take_supernodes(const cholmod_factor& factor, SupernodeTree& tree) {
  const auto* order = static_cast<const SuiteSparse_long*>(factor.Perm);
  const auto* super = static_cast<const SuiteSparse_long*>(factor.super);
  const auto* starts = static_cast<const SuiteSparse_long*>(factor.pi);
  const auto* rows = static_cast<const SuiteSparse_long*>(factor.s);
  tree.order.assign(order, order + factor.n);
  tree.first.assign(super, super + factor.nsuper + 1);
  tree.row_start.assign(starts, starts + factor.nsuper + 1);
  tree.rows.assign(rows, rows + factor.ssize);
  tree.parent.assign(factor.nsuper, -1);
}

}  // namespace

void find_supernodes(const SparseMatrix& lower, const std::vector<int64_t>& order, bool merged,
                     SupernodeTree& tree) {
  Common common(merged);
  LongPattern pattern(lower);
  std::vector<SuiteSparse_long> given(order.begin(), order.end());
  cholmod_factor* factor =
      cholmod_l_analyze_p(&pattern.view, given.data(), nullptr, 0, common.get());
  const int status = common->status;  // the next CHOLMOD call resets it (hard case C1)
  if (factor == nullptr || status < CHOLMOD_OK) fail_for_status(status);
  take_supernodes(*factor, tree);
  cholmod_l_free_factor(&factor, common.get());
}

}  // namespace clatter::sparse
