// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/arpack_solver.hpp"

#include <arpack.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <numeric>
#include <random>
#include <vector>

namespace clatter::sparse {
namespace {

static_assert(sizeof(a_int) == 4,
              "Debian's ARPACK has 32-bit integers; a wider build would corrupt memory");

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

ArpackArrays arrays_of(const ShiftInvert& problem, const ArpackOptions& options, int basis) {
  ArpackArrays out;
  out.n = static_cast<int>(problem.size);
  out.nev = options.count;
  out.ncv = basis;
  out.lworkl = basis * (basis + 8);
  out.tolerance = options.tolerance;
  out.sigma = problem.sigma;
  out.resid.resize(out.n);
  out.workd.resize(static_cast<size_t>(out.n) * 3);
  out.workl.resize(out.lworkl);
  out.v.resize(out.n, out.ncv);
  out.iparam[0] = 1;  // exact shifts
  out.iparam[2] = options.max_restarts;
  out.iparam[3] = 1;
  out.iparam[6] = 3;  // shift-invert
  if (options.start.size() == out.n) {
    std::copy(options.start.begin(), options.start.end(), out.resid.begin());
  } else {
    // A random start has a component in every mode; a symmetric one misses half of them (A2).
    std::mt19937_64 engine(options.seed + static_cast<uint64_t>(problem.team->rank()));
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::generate(out.resid.begin(), out.resid.end(), [&] { return uniform(engine); });
  }
  return out;
}

/// The reverse communication loop. Returns false when the operator returns non-finite values.
bool iterate(const ShiftInvert& problem, const ArpackRoutines& routines, ArpackArrays& arrays,
             int64_t& solves) {
  while (true) {
    routines.iterate(arrays);
    const auto at = [&](int pointer) { return arrays.workd.data() + arrays.ipntr[pointer] - 1; };
    if (arrays.ido == -1) {
      Eigen::VectorXd image(arrays.n);
      problem.mass(at(0), image.data(), 1);
      problem.solve(image.data(), at(1), 1);
    } else if (arrays.ido == 1) {
      problem.solve(at(2), at(1), 1);  // already contains M x
    } else if (arrays.ido == 2) {
      problem.mass(at(0), at(1), 1);
    } else {
      return true;
    }
    if (arrays.ido != 2) ++solves;
    if (problem.team->any(!Eigen::Map<const Eigen::VectorXd>(at(1), arrays.n).allFinite()))
      return false;
  }
}

/// Extraction; only after a successful run (hard case A3).
EigenResult extract(const ShiftInvert& problem, const ArpackRoutines& routines,
                    ArpackArrays& arrays) {
  const int converged = arrays.iparam[4];
  arrays.select.assign(arrays.ncv, 0);
  arrays.d = Eigen::VectorXd::Zero(arrays.nev);
  arrays.z.resize(arrays.n, arrays.nev);
  routines.extract(arrays);
  if (arrays.info != 0) {
    return refuse(EigenStatus::kFailed, fmt::format("ARPACK extraction: code {}", arrays.info));
  }
  std::vector<Eigen::Index> order(static_cast<size_t>(converged));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return arrays.d[a] < arrays.d[b]; });
  EigenResult result;
  result.values = arrays.d(order);
  result.vectors = arrays.z(Eigen::all, order);
  result.status = EigenStatus::kConverged;
  if (problem.team->any(!result.values.allFinite() || !result.vectors.allFinite())) {
    return refuse(EigenStatus::kFailed, "ARPACK returned values that are not finite");
  }
  return result;
}

/// Sizes that ARPACK's 32-bit counters hold (hard case A9); computed in 64 bits.
/// @param n of the team; @param rows of the process that has most.
std::string size_problem(int64_t n, int64_t rows, int64_t count, int64_t basis) {
  constexpr int64_t kMax = std::numeric_limits<int32_t>::max();
  if (count < 1) return fmt::format("{} modes requested, expected at least 1", count);
  if (basis > n || count >= basis) {
    return fmt::format(
        "{} modes with {} Lanczos vectors of {} unknowns: expected modes < vectors "
        "<= unknowns",
        count, basis, n);
  }
  if (rows > kMax / 3 || rows * basis > kMax || basis * (basis + 8) > kMax) {
    return fmt::format("{} Lanczos vectors of {} unknowns exceed ARPACK's 32-bit counters", basis,
                       rows);
  }
  return {};
}

}  // namespace

void ArpackRoutines::iterate(ArpackArrays& a) const {
  dsaupd_c(&a.ido, &ArpackArrays::kMassInProduct, a.n, ArpackArrays::kLargestMagnitude, a.nev,
           a.tolerance, a.resid.data(), a.ncv, a.v.data(), a.n, a.iparam.data(), a.ipntr.data(),
           a.workd.data(), a.workl.data(), a.lworkl, &a.info);
}

void ArpackRoutines::extract(ArpackArrays& a) const {
  dseupd_c(1, "A", a.select.data(), a.d.data(), a.z.data(), a.n, a.sigma,
           &ArpackArrays::kMassInProduct, a.n, ArpackArrays::kLargestMagnitude, a.nev, a.tolerance,
           a.resid.data(), a.ncv, a.v.data(), a.n, a.iparam.data(), a.ipntr.data(), a.workd.data(),
           a.workl.data(), a.lworkl, &a.info);
}

EigenResult solve_arpack(const ShiftInvert& problem, const ArpackOptions& options,
                         const ArpackRoutines& routines) {
  const auto own = static_cast<double>(problem.size);
  const auto n = static_cast<int64_t>(problem.team->sum(own));
  const auto rows = static_cast<int64_t>(-problem.team->least(-own));
  const int64_t basis =
      options.basis > 0 ? options.basis : std::min<int64_t>(n, 2 * int64_t{options.count} + 10);
  const std::string wrong = size_problem(n, rows, options.count, basis);
  if (!wrong.empty()) return refuse(EigenStatus::kBadInput, wrong);
  const std::lock_guard<std::mutex> lock(arpack_mutex());
  ArpackArrays arrays = arrays_of(problem, options, static_cast<int>(basis));
  int64_t solves = 0;
  EigenResult result;
  if (!iterate(problem, routines, arrays, solves)) {
    result = refuse(EigenStatus::kOperatorFailed, "the solve returned values that are not finite");
  } else if (arrays.info == 0 && arrays.iparam[4] >= arrays.nev && arrays.iparam[4] <= arrays.nev) {
    result = extract(problem, routines, arrays);
  } else {
    const bool short_of = arrays.info == 1 || arrays.info == 0;
    result = refuse(short_of ? EigenStatus::kNotConverged : EigenStatus::kFailed,
                    meaning(arrays.info == 0 ? 1 : arrays.info, arrays.iparam[4], arrays.nev));
  }
  result.solves = solves;
  return result;
}

std::string arpack_version() { return CLATTER_ARPACK_VERSION; }

}  // namespace clatter::sparse
