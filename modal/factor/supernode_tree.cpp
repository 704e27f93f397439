#include "modal/factor/supernode_tree.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "core/error.hpp"
#include "core/stopwatch.hpp"

namespace clatter::modal {
namespace {

/// CHOLMOD's settings and workspace; its messages stay silent because we report them ourselves.
class Common {
 public:
  Common() {
    cholmod_l_start(&data_);
    data_.print = 0;
    data_.error_handler = nullptr;
    data_.supernodal = CHOLMOD_SUPERNODAL;
    data_.nmethods = 1;
    data_.method[0].ordering = CHOLMOD_GIVEN;
    // Larger blocks than CHOLMOD's own choice: our fronts and sweeps live by BLAS-3.
    data_.nrelax[0] = 8;
    data_.nrelax[1] = 32;
    data_.nrelax[2] = 96;
  }
  ~Common() { cholmod_l_finish(&data_); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;
  cholmod_common* get() { return &data_; }
  cholmod_common* operator->() { return &data_; }

 private:
  cholmod_common data_;
};

/// The pattern as CHOLMOD wants it: long indices, lower triangle.
struct LongPattern {
  std::vector<SuiteSparse_long> starts, rows;
  cholmod_sparse view{};

  explicit LongPattern(const SparseMatrix& lower) {
    const auto n = static_cast<size_t>(lower.cols());
    starts.assign(n + 1, 0);
    rows.reserve(static_cast<size_t>(lower.nonZeros()));
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

/// Fills what the eliminated unknowns alone decide.
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

void find_parents(SupernodeTree& tree) {
  std::vector<int32_t> owner(static_cast<size_t>(tree.size));
  for (int32_t s = 0; s < tree.supernodes(); ++s)
    for (int32_t j = tree.first[static_cast<size_t>(s)]; j < tree.first[static_cast<size_t>(s) + 1];
         ++j)
      owner[static_cast<size_t>(j)] = s;
  for (int32_t s = 0; s < tree.supernodes(); ++s) {
    if (tree.below(s) == 0) continue;
    const int32_t row = tree.rows_of(s)[tree.columns(s)];
    tree.parent[static_cast<size_t>(s)] = owner[static_cast<size_t>(row)];
  }
}

/// Appends to each front the boundary unknowns that its subtree touches.
void add_boundary_rows(const SparseMatrix& coupling, SupernodeTree& tree) {
  tree.boundary = static_cast<int32_t>(coupling.cols());
  std::vector<int32_t> place(static_cast<size_t>(tree.size)), owner(place.size());
  for (int32_t j = 0; j < tree.size; ++j)
    place[static_cast<size_t>(tree.order[static_cast<size_t>(j)])] = j;
  for (int32_t s = 0; s < tree.supernodes(); ++s)
    for (int32_t j = tree.first[static_cast<size_t>(s)]; j < tree.first[static_cast<size_t>(s) + 1];
         ++j)
      owner[static_cast<size_t>(j)] = s;
  std::vector<std::vector<int32_t>> touched(tree.parent.size());
  for (int32_t b = 0; b < tree.boundary; ++b) {
    for (SparseMatrix::InnerIterator it(coupling, b); it; ++it) {
      auto& list = touched[static_cast<size_t>(
          owner[static_cast<size_t>(place[static_cast<size_t>(it.row())])])];
      if (list.empty() || list.back() != b) list.push_back(b);
    }
  }
  std::vector<int64_t> starts{0};
  std::vector<int32_t> rows;
  for (int32_t s = 0; s < tree.supernodes(); ++s) {
    auto& list = touched[static_cast<size_t>(s)];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    rows.insert(rows.end(), tree.rows_of(s), tree.rows_of(s) + tree.height(s));
    for (const int32_t b : list) rows.push_back(tree.size + b);
    starts.push_back(static_cast<int64_t>(rows.size()));
    const int32_t parent = tree.parent[static_cast<size_t>(s)];
    if (parent < 0) continue;
    auto& above = touched[static_cast<size_t>(parent)];
    above.insert(above.end(), list.begin(), list.end());
    std::vector<int32_t>().swap(list);
  }
  tree.row_start.swap(starts);
  tree.rows.swap(rows);
}

}  // namespace

int32_t SupernodeTree::interior_below(int32_t s) const {
  const int32_t* begin = rows_of(s) + columns(s);
  return static_cast<int32_t>(std::lower_bound(begin, begin + below(s), size) - begin);
}

double SupernodeTree::flops(int32_t s) const {
  const double p = columns(s), q = below(s);
  return p * p * p / 3.0 + p * p * q + p * q * q;
}

double SupernodeTree::flops() const {
  double sum = 0.0;
  for (int32_t s = 0; s < supernodes(); ++s) sum += flops(s);
  return sum;
}

int64_t SupernodeTree::stack_entries() const {
  std::vector<int64_t> of_children(parent.size(), 0);
  int64_t now = 0, peak = 0;
  for (int32_t s = 0; s < supernodes(); ++s) {
    const int64_t own = int64_t{below(s)} * below(s);
    peak = std::max(peak, now + own);
    now += own - of_children[at(s)];
    if (parent[at(s)] >= 0) of_children[at(parent[at(s)])] += own;
  }
  return peak;
}

std::vector<std::vector<int32_t>> SupernodeTree::children() const {
  std::vector<std::vector<int32_t>> out(parent.size());
  for (int32_t s = 0; s < supernodes(); ++s)
    if (parent[at(s)] >= 0) out[at(parent[at(s)])].push_back(s);
  return out;
}

SupernodeTree analyse_tree(const SparseMatrix& lower, const TreeOptions& options,
                           const SparseMatrix& coupling) {
  const Stopwatch clock;
  SupernodeTree tree;
  tree.size = static_cast<int32_t>(lower.cols());
  std::vector<SuiteSparse_long> order(options.permutation.begin(), options.permutation.end());
  tree.ordering = "given";
  if (order.empty()) {
    const FillOrder found = fill_reducing_order(lower, options.ordering);
    order.assign(found.order.begin(), found.order.end());
    tree.ordering = ordering_name(found.method);
  }
  if (order.size() != static_cast<size_t>(tree.size))
    throw NumericsError(fmt::format("ordering: found a permutation of {} unknowns, expected {}",
                                    order.size(), tree.size));
  Common common;
  LongPattern pattern(lower);
  cholmod_factor* factor =
      cholmod_l_analyze_p(&pattern.view, order.data(), nullptr, 0, common.get());
  const int status = common->status;
  if (factor == nullptr || status < CHOLMOD_OK) fail_for_status(status);
  take_supernodes(*factor, tree);
  cholmod_l_free_factor(&factor, common.get());
  find_parents(tree);
  if (coupling.cols() > 0) add_boundary_rows(coupling, tree);
  tree.panel_start.assign(1, 0);
  for (int32_t s = 0; s < tree.supernodes(); ++s)
    tree.panel_start.push_back(tree.panel_start.back() + int64_t{tree.columns(s)} * tree.height(s));
  tree.seconds = clock.seconds();
  return tree;
}

}  // namespace clatter::modal
