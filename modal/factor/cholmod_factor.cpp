#include "modal/factor/cholmod_factor.hpp"

#include <cholmod.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <random>

#include "core/stopwatch.hpp"

namespace clatter::modal {
namespace {

constexpr int64_t kBlock = 64;  // right-hand sides a sweep: the factor is read once for all of them
constexpr double kGib = 1024.0 * 1024.0 * 1024.0;

double machine_memory_gib() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(sysconf(_SC_PAGE_SIZE)) / kGib;
}

/// CHOLMOD's settings and workspace; its messages stay silent because we report them ourselves.
class Common {
 public:
  Common() {
    cholmod_l_start(&data_);
    data_.print = 0;
    data_.error_handler = nullptr;
    data_.supernodal = CHOLMOD_SUPERNODAL;
    data_.final_ll = 1;
    // METIS ends the process when memory runs out; CHOLMOD then keeps a margin of twice its need
    // and falls back to AMD (hard case C6).
    data_.metis_memory = 2.0;
  }
  ~Common() { cholmod_l_finish(&data_); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;
  cholmod_common* get() { return &data_; }
  cholmod_common* operator->() { return &data_; }

 private:
  cholmod_common data_;
};

/// A copy with long indices, symmetrically scaled. CHOLMOD sees it as stype = -1 (lower).
struct LongMatrix {
  std::vector<SuiteSparse_long> starts, rows;
  std::vector<double> values;
  cholmod_sparse view{};

  LongMatrix(const SparseMatrix& lower, const std::vector<double>& scale) {
    const int64_t n = lower.cols();
    starts.assign(static_cast<size_t>(n + 1), 0);
    rows.reserve(static_cast<size_t>(lower.nonZeros()));
    values.reserve(static_cast<size_t>(lower.nonZeros()));
    for (int64_t j = 0; j < n; ++j) {
      for (SparseMatrix::InnerIterator it(lower, static_cast<int>(j)); it; ++it) {
        if (it.row() < j) continue;
        rows.push_back(it.row());
        values.push_back(it.value() * scale[static_cast<size_t>(j)] *
                         scale[static_cast<size_t>(it.row())]);
      }
      starts[static_cast<size_t>(j + 1)] = static_cast<SuiteSparse_long>(rows.size());
    }
    view.nrow = view.ncol = static_cast<size_t>(n);
    view.nzmax = rows.size();
    view.p = starts.data();
    view.i = rows.data();
    view.x = values.data();
    view.stype = -1;
    view.itype = CHOLMOD_LONG;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
  }
};

/// diag(A)^(-1/2), rounded to powers of two so that scaling adds no rounding error.
std::vector<double> power_of_two_scale(const SparseMatrix& lower) {
  std::vector<double> scale(static_cast<size_t>(lower.cols()), 1.0);
  for (int j = 0; j < lower.cols(); ++j) {
    const double d = lower.coeff(j, j);
    if (!(d > 0.0) || !std::isfinite(d)) {
      throw NotPositiveDefinite(
          fmt::format("matrix is not positive definite: diagonal {} is {}", j, d), j);
    }
    scale[static_cast<size_t>(j)] = std::exp2(-std::round(0.5 * std::log2(d)));
  }
  return scale;
}

std::string ordering_name(int method) {
  if (method == CHOLMOD_METIS) return "metis";
  if (method == CHOLMOD_AMD) return "amd";
  if (method == CHOLMOD_NATURAL) return "natural";
  return method == CHOLMOD_GIVEN ? "given" : "other";
}

void choose_ordering(Common& common, const FactorOptions& options, int64_t n, int64_t entries) {
  common->nmethods = 1;
  common->method[0].ordering = CHOLMOD_AMD;
  const Ordering ordering = safe_ordering(options.ordering, n, entries);
  if (!options.permutation.empty()) {
    common->method[0].ordering = CHOLMOD_GIVEN;
  } else if (ordering == Ordering::kMetis) {
    common->method[0].ordering = CHOLMOD_METIS;
  } else if (ordering == Ordering::kNatural) {
    common->method[0].ordering = CHOLMOD_NATURAL;
    common->postorder = 0;
  }
}

[[noreturn]] void fail_for_status(int status, const char* doing) {
  if (status == CHOLMOD_OUT_OF_MEMORY) {
    throw NumericsError(fmt::format("out of memory while {} the matrix", doing));
  }
  if (status == CHOLMOD_TOO_LARGE) {
    throw NumericsError(fmt::format("the matrix is too large while {} it", doing));
  }
  throw NumericsError(fmt::format("CHOLMOD failed with status {} while {}", status, doing));
}

/// Orders and counts; the caller frees the symbolic factor.
cholmod_factor* analyse(Common& common, LongMatrix& matrix, const FactorOptions& options,
                        FactorReport& report) {
  const Stopwatch clock;
  const auto n = static_cast<int64_t>(matrix.view.ncol);
  choose_ordering(common, options, n, static_cast<int64_t>(matrix.view.nzmax));
  std::vector<SuiteSparse_long> given(options.permutation.begin(), options.permutation.end());
  cholmod_factor* factor = cholmod_l_analyze_p(&matrix.view, given.empty() ? nullptr : given.data(),
                                               nullptr, 0, common.get());
  const int status = common->status;
  if (factor == nullptr || status < CHOLMOD_OK) fail_for_status(status, "ordering");
  report.size = n;
  report.entries = static_cast<int64_t>(common->lnz);
  report.flops = common->fl;
  report.predicted_gib = 8.0 * std::max(common->lnz, static_cast<double>(factor->xsize)) / kGib;
  report.ordering = ordering_name(factor->ordering);
  report.analyse_seconds = clock.seconds();
  return factor;
}

void refuse_if_too_large(const FactorReport& report, const FactorOptions& options) {
  const double limit =
      options.memory_limit_gib > 0.0 ? options.memory_limit_gib : machine_memory_gib();
  if (report.predicted_gib <= limit) return;
  throw NumericsError(fmt::format(
      "the factor of {} unknowns needs {:.1f} GiB ({} entries), the limit is {:.1f} GiB: use a "
      "coarser mesh or raise the limit",
      report.size, report.predicted_gib, report.entries, limit));
}

Eigen::VectorXd random_vector(int64_t n) {
  std::mt19937_64 engine(20240607);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::VectorXd b(n);
  for (double& value : b) value = uniform(engine);
  return b;
}

}  // namespace

Ordering safe_ordering(Ordering wanted, int64_t size, int64_t lower_entries) {
  const int64_t full = 2 * (lower_entries - size);
  const bool fits =
      full < std::numeric_limits<int32_t>::max() && size < std::numeric_limits<int32_t>::max();
  return wanted == Ordering::kMetis && !fits ? Ordering::kAmd : wanted;
}

struct CholmodFactor::Impl {
  mutable Common common;
  mutable std::mutex mutex;
  std::vector<double> scale;
  cholmod_factor* factor = nullptr;
  FactorReport report;
  mutable cholmod_dense* solution = nullptr;  // workspaces of solve, kept between calls
  mutable cholmod_dense* work_y = nullptr;
  mutable cholmod_dense* work_e = nullptr;

  ~Impl() {
    cholmod_l_free_dense(&solution, common.get());
    cholmod_l_free_dense(&work_y, common.get());
    cholmod_l_free_dense(&work_e, common.get());
    cholmod_l_free_factor(&factor, common.get());
  }

  void factorise(LongMatrix& matrix, const FactorOptions& options);
  void check_pivots(const FactorOptions& options);
  void probe(const SparseMatrix& lower, const FactorOptions& options);
  /// x = S L^{-T} L^{-1} S b for m columns with leading dimension n.
  void solve_block(const double* b, double* x, int64_t m) const;
};

void CholmodFactor::Impl::factorise(LongMatrix& matrix, const FactorOptions& options) {
  factor = analyse(common, matrix, options, report);
  refuse_if_too_large(report, options);
  const Stopwatch clock;
  cholmod_l_factorize(&matrix.view, factor, common.get());
  // The next CHOLMOD call resets the status (hard case C1): read it before anything else.
  const int status = common->status;
  report.factor_seconds = clock.seconds();
  if (status == CHOLMOD_NOT_POSDEF || (status >= CHOLMOD_OK && factor->minor != factor->n)) {
    const auto* order = static_cast<const SuiteSparse_long*>(factor->Perm);
    const int64_t column = factor->minor < factor->n ? order[factor->minor] : -1;
    throw NotPositiveDefinite(
        fmt::format("matrix is not positive definite: factorisation stopped at column {}", column),
        column);
  }
  if (status != CHOLMOD_OK && status != CHOLMOD_DSMALL) fail_for_status(status, "factorising");
}

void CholmodFactor::Impl::check_pivots(const FactorOptions& options) {
  report.rcond = cholmod_l_rcond(factor, common.get());
  if (report.rcond >= options.min_rcond) return;
  throw NotPositiveDefinite(
      fmt::format("matrix is singular to working precision: ratio of pivots {:.1e} < {:.1e}",
                  report.rcond, options.min_rcond),
      -1);
}

/// A singular matrix that slipped through turns the part of b in its null space, about 1/sqrt(n) of
/// it, into a huge x: the residual is then not small, or x as large as rounding allows.
void CholmodFactor::Impl::probe(const SparseMatrix& lower, const FactorOptions& options) {
  constexpr double kSmallResidual = 1e-10;
  const auto n = lower.rows();
  const Eigen::Map<const Eigen::VectorXd> s(scale.data(), n);
  const Eigen::VectorXd b = random_vector(n);  // in the scaled matrix every row weighs the same
  const Eigen::VectorXd rhs = b.cwiseQuotient(s);
  Eigen::VectorXd x(n);
  solve_block(rhs.data(), x.data(), 1);
  const Eigen::VectorXd r = rhs - lower.selfadjointView<Eigen::Lower>() * x;
  report.probe_residual = r.cwiseProduct(s).norm() / b.norm();
  // The largest diagonal entry of the scaled matrix lies in [1/2, 2]; that is |A| well enough.
  report.probe_condition = x.cwiseQuotient(s).norm() / b.norm();
  const double rounding = 100.0 * std::numeric_limits<double>::epsilon() * report.probe_condition;
  if (report.probe_condition <= options.max_condition &&
      report.probe_residual <= std::max(kSmallResidual, rounding)) {
    return;
  }
  throw NotPositiveDefinite(
      fmt::format("matrix is singular to working precision: a random solve has residual {:.1e} and "
                  "grows by {:.1e}",
                  report.probe_residual, report.probe_condition),
      -1);
}

void CholmodFactor::Impl::solve_block(const double* b, double* x, int64_t m) const {
  const auto n = static_cast<int64_t>(factor->n);
  Eigen::Map<Eigen::MatrixXd> out(x, n, m);
  const Eigen::Map<const Eigen::VectorXd> s(scale.data(), n);
  out = s.asDiagonal() * Eigen::Map<const Eigen::MatrixXd>(b, n, m);
  cholmod_dense rhs{};
  rhs.nrow = rhs.d = static_cast<size_t>(n);
  rhs.ncol = static_cast<size_t>(m);
  rhs.nzmax = static_cast<size_t>(n * m);
  rhs.x = x;
  rhs.xtype = CHOLMOD_REAL;
  rhs.dtype = CHOLMOD_DOUBLE;
  const int ok = cholmod_l_solve2(CHOLMOD_A, factor, &rhs, nullptr, &solution, nullptr, &work_y,
                                  &work_e, common.get());
  const int status = common->status;
  if (ok == 0 || status < CHOLMOD_OK) fail_for_status(status, "solving with");
  const auto* values = static_cast<const double*>(solution->x);
  out = s.asDiagonal() * Eigen::Map<const Eigen::MatrixXd>(values, n, m);
}

CholmodFactor::CholmodFactor(const SparseMatrix& lower, const FactorOptions& options)
    : impl_(std::make_unique<Impl>()) {
  impl_->scale = power_of_two_scale(lower);
  {
    LongMatrix matrix(lower, impl_->scale);
    impl_->factorise(matrix, options);
  }
  impl_->check_pivots(options);
  impl_->probe(lower, options);
}

FactorReport CholmodFactor::predict(const SparseMatrix& lower, const FactorOptions& options) {
  Common common;
  FactorReport report;
  LongMatrix matrix(lower, std::vector<double>(static_cast<size_t>(lower.cols()), 1.0));
  cholmod_factor* factor = analyse(common, matrix, options, report);
  cholmod_l_free_factor(&factor, common.get());
  return report;
}

CholmodFactor::~CholmodFactor() = default;
CholmodFactor::CholmodFactor(CholmodFactor&&) noexcept = default;
CholmodFactor& CholmodFactor::operator=(CholmodFactor&&) noexcept = default;

Eigen::MatrixXd CholmodFactor::solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  Eigen::MatrixXd x(b.rows(), b.cols());
  Eigen::MatrixXd block;
  for (int64_t first = 0; first < b.cols(); first += kBlock) {
    const int64_t count = std::min<int64_t>(kBlock, b.cols() - first);
    block = b.middleCols(first, count);
    impl_->solve_block(block.data(), x.col(first).data(), count);
  }
  return x;
}

void CholmodFactor::solve(const double* b, double* x) const {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->solve_block(b, x, 1);
}

int64_t CholmodFactor::size() const { return static_cast<int64_t>(impl_->factor->n); }
const FactorReport& CholmodFactor::report() const { return impl_->report; }

std::vector<int64_t> CholmodFactor::permutation() const {
  const auto* order = static_cast<const SuiteSparse_long*>(impl_->factor->Perm);
  return std::vector<int64_t>(order, order + impl_->factor->n);
}

}  // namespace clatter::modal
