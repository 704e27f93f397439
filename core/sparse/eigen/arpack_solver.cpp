// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/arpack_solver.hpp"

#include <arpack.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <mutex>
#include <numeric>
#include <random>
#include <vector>

namespace clatter::sparse {
namespace {

static_assert(sizeof(a_int) == 4,
              "Debian's ARPACK has 32-bit integers; a wider build would corrupt memory");

constexpr char kMassInProduct = 'G';
constexpr const char* kLargestMagnitude = "LM";  // never "SM": see hard case A5

std::mutex& arpack_mutex() {
  static std::mutex mutex;
  return mutex;
}

EigenResult refuse(EigenStatus status, std::string message) {
  EigenResult result;
  result.status = status;
  result.message = std::move(message);
  return result;
}

std::string meaning(int info, int converged, int wanted) {
  switch (info) {
    case 1:
      return fmt::format("{} of {} modes converged in the allowed restarts", converged, wanted);
    case 3:
      return "no shifts could be applied: more Lanczos vectors are needed";
    case -8:
      return "the eigenvalues of the small tridiagonal matrix failed";
    case -9:
      return "the start vector is zero";
    case -9999:
      return fmt::format("no Lanczos factorisation could be built ({} steps)", converged);
    default:
      return fmt::format("ARPACK code {}", info);
  }
}

/// ARPACK's arrays for one run; names follow its guide.
struct Workspace {
  Workspace(const ShiftInvert& problem, const ArpackOptions& options, a_int basis)
      : n(static_cast<a_int>(problem.size)),
        nev(options.count),
        ncv(basis),
        lworkl(ncv * (ncv + 8)),
        resid(static_cast<size_t>(n)),
        workd(static_cast<size_t>(n) * 3),
        workl(static_cast<size_t>(lworkl)),
        v(n, ncv) {
    iparam[0] = 1;  // exact shifts
    iparam[2] = options.max_restarts;
    iparam[3] = 1;
    iparam[6] = 3;  // shift-invert
    if (options.start.size() == n) {
      std::copy(options.start.begin(), options.start.end(), resid.begin());
    } else {
      // A random start has a component in every mode; a symmetric one misses half of them (A2).
      std::mt19937_64 engine(options.seed);
      std::uniform_real_distribution<double> uniform(-1.0, 1.0);
      std::generate(resid.begin(), resid.end(), [&] { return uniform(engine); });
    }
  }

  a_int n, nev, ncv, lworkl;
  std::vector<double> resid, workd, workl;
  Eigen::MatrixXd v;
  std::array<a_int, 11> iparam{};
  std::array<a_int, 14> ipntr{};
  a_int info = 1;  // resid holds the start vector
};

/// The reverse communication loop. Returns false when the operator returns non-finite values.
bool iterate(const ShiftInvert& problem, const ArpackOptions& options, Workspace& work,
             int64_t& solves) {
  a_int ido = 0;
  while (true) {
    dsaupd_c(&ido, &kMassInProduct, work.n, kLargestMagnitude, work.nev, options.tolerance,
             work.resid.data(), work.ncv, work.v.data(), work.n, work.iparam.data(),
             work.ipntr.data(), work.workd.data(), work.workl.data(), work.lworkl, &work.info);
    const auto at = [&](int pointer) {
      return work.workd.data() + work.ipntr[static_cast<size_t>(pointer)] - 1;
    };
    if (ido == -1) {
      Eigen::VectorXd image(work.n);
      problem.mass(at(0), image.data(), 1);
      problem.solve(image.data(), at(1), 1);
    } else if (ido == 1) {
      problem.solve(at(2), at(1), 1);  // already contains M x
    } else if (ido == 2) {
      problem.mass(at(0), at(1), 1);
    } else {
      return true;
    }
    if (ido != 2) ++solves;
    if (!Eigen::Map<const Eigen::VectorXd>(at(1), work.n).allFinite()) return false;
  }
}

/// Extraction; only after a successful run (hard case A3).
EigenResult extract(const ShiftInvert& problem, const ArpackOptions& options, Workspace& work) {
  const a_int converged = work.iparam[4];
  std::vector<a_int> select(static_cast<size_t>(work.ncv), 0);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(work.nev);
  Eigen::MatrixXd z(work.n, work.nev);
  dseupd_c(1, "A", select.data(), d.data(), z.data(), work.n, problem.sigma, &kMassInProduct,
           work.n, kLargestMagnitude, work.nev, options.tolerance, work.resid.data(), work.ncv,
           work.v.data(), work.n, work.iparam.data(), work.ipntr.data(), work.workd.data(),
           work.workl.data(), work.lworkl, &work.info);
  if (work.info != 0) {
    return refuse(EigenStatus::kFailed, fmt::format("ARPACK extraction: code {}", work.info));
  }
  std::vector<Eigen::Index> order(static_cast<size_t>(converged));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return d[a] < d[b]; });
  EigenResult result;
  result.values = d(order);
  result.vectors = z(Eigen::all, order);
  result.status = EigenStatus::kConverged;
  if (!result.values.allFinite() || !result.vectors.allFinite()) {
    return refuse(EigenStatus::kFailed, "ARPACK returned values that are not finite");
  }
  return result;
}

/// Sizes that ARPACK's 32-bit counters hold (hard case A9); computed in 64 bits.
std::string size_problem(int64_t n, int64_t count, int64_t basis) {
  constexpr int64_t kMax = std::numeric_limits<int32_t>::max();
  if (count < 1) return fmt::format("{} modes requested, expected at least 1", count);
  if (basis > n || count >= basis) {
    return fmt::format(
        "{} modes with {} Lanczos vectors of {} unknowns: expected modes < vectors "
        "<= unknowns",
        count, basis, n);
  }
  if (n > kMax / 3 || n * basis > kMax || basis * (basis + 8) > kMax) {
    return fmt::format("{} Lanczos vectors of {} unknowns exceed ARPACK's 32-bit counters", basis,
                       n);
  }
  return {};
}

}  // namespace

EigenResult solve_arpack(const ShiftInvert& problem, const ArpackOptions& options) {
  const int64_t basis = options.basis > 0
                            ? options.basis
                            : std::min<int64_t>(problem.size, 2 * int64_t{options.count} + 10);
  const std::string wrong = size_problem(problem.size, options.count, basis);
  if (!wrong.empty()) return refuse(EigenStatus::kBadInput, wrong);
  const std::lock_guard<std::mutex> lock(arpack_mutex());
  Workspace work(problem, options, static_cast<a_int>(basis));
  int64_t solves = 0;
  EigenResult result;
  if (!iterate(problem, options, work, solves)) {
    result = refuse(EigenStatus::kOperatorFailed, "the solve returned values that are not finite");
  } else if (work.info == 0 && work.iparam[4] >= work.nev && work.iparam[4] <= work.nev) {
    result = extract(problem, options, work);
  } else {
    const bool short_of = work.info == 1 || work.info == 0;
    result = refuse(short_of ? EigenStatus::kNotConverged : EigenStatus::kFailed,
                    meaning(work.info == 0 ? 1 : work.info, work.iparam[4], work.nev));
  }
  result.solves = solves;
  return result;
}

std::string arpack_version() { return CLATTER_ARPACK_VERSION; }

}  // namespace clatter::sparse
