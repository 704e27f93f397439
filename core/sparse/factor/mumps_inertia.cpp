// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/mumps_inertia.hpp"

#include <dmumps_c.h>
#include <fmt/format.h>
#ifdef CLATTER_MUMPS_MPI
#include <mpi.h>
#endif

#include <cmath>
#include <mutex>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"

namespace clatter::sparse {
namespace {

/// What MUMPS calls the processes that factorise: this one alone.
MUMPS_INT own_communicator() {
#ifdef CLATTER_MUMPS_MPI
  return static_cast<MUMPS_INT>(MPI_Comm_c2f(MPI_COMM_SELF));
#else
  return -987654;  // the value that the sequential library expects
#endif
}

enum Job { kStart = -1, kEnd = -2, kAnalyse = 1, kFactorise = 2 };

/// MUMPS keeps state in its library: one instance at a time.
std::mutex& mumps_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// One MUMPS instance for a symmetric indefinite matrix; parameters are numbered as in its guide.
class Mumps {
 public:
  Mumps() {
    data_.par = 1;
    data_.sym = 2;
    data_.comm_fortran = own_communicator();
    run(kStart);
    for (int stream = 1; stream <= 3; ++stream) icntl(stream) = -1;
    icntl(4) = 0;
  }
  ~Mumps() {
    data_.job = kEnd;
    dmumps_c(&data_);
  }
  Mumps(const Mumps&) = delete;
  Mumps& operator=(const Mumps&) = delete;

  void run(Job job) {
    data_.job = job;
    dmumps_c(&data_);
  }
  MUMPS_INT& icntl(int i) { return data_.icntl[i - 1]; }
  MUMPS_INT infog(int i) const { return data_.infog[i - 1]; }
  DMUMPS_STRUC_C& data() { return data_; }

 private:
  DMUMPS_STRUC_C data_{};
};

struct Triplets {
  std::vector<MUMPS_INT> rows, columns;
  std::vector<double> values;
};

/// Lower triangle of K - mu M, 1-based.
Triplets shifted_triplets(const SparseMatrix& K, const SparseMatrix& M, double mu) {
  const SparseMatrix shifted = K - mu * M;
  Triplets out;
  const auto count = static_cast<size_t>(shifted.nonZeros());
  out.rows.reserve(count);
  out.columns.reserve(count);
  out.values.reserve(count);
  for (int j = 0; j < shifted.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(shifted, j); it; ++it) {
      if (it.row() < j) continue;
      out.rows.push_back(static_cast<MUMPS_INT>(it.row() + 1));
      out.columns.push_back(j + 1);
      out.values.push_back(it.value());
    }
  }
  return out;
}

void analyse(Mumps& mumps, const std::vector<int64_t>& permutation) {
  std::vector<MUMPS_INT> position(permutation.size());
  for (size_t index = 0; index < permutation.size(); ++index) {
    position[permutation[index]] = static_cast<MUMPS_INT>(index + 1);
  }
  mumps.icntl(6) = 0;                            // keep the diagonal unpermuted
  mumps.icntl(7) = permutation.empty() ? 5 : 1;  // METIS, or the given order
  mumps.icntl(12) = 1;                           // plain ordering of the pattern
  mumps.icntl(13) = 1;                           // inertia of the root as well
  mumps.icntl(24) = 1;                           // report null pivots
  mumps.icntl(31) = 1;                           // discard the factor
  mumps.data().perm_in = permutation.empty() ? nullptr : position.data();
  mumps.run(kAnalyse);
  mumps.data().perm_in = nullptr;
  if (mumps.infog(1) < 0) {
    throw NumericsError(fmt::format("inertia count: MUMPS analysis failed with code {} ({})",
                                    mumps.infog(1), mumps.infog(2)));
  }
}

/// Factorises; delayed pivots may need more workspace than predicted, so it is raised and retried.
void factorise(Mumps& mumps) {
  constexpr MUMPS_INT kRelaxation[] = {30, 100, 300};  // [%]
  for (const MUMPS_INT percent : kRelaxation) {
    mumps.icntl(14) = percent;
    mumps.run(kFactorise);
    if (mumps.infog(1) >= 0) return;
    if (mumps.infog(1) != -8 && mumps.infog(1) != -9) break;
  }
  throw NumericsError(fmt::format("inertia count: MUMPS factorisation failed with code {} ({})",
                                  mumps.infog(1), mumps.infog(2)));
}

}  // namespace

InertiaCount count_below_by_mumps(const SparseMatrix& K, const SparseMatrix& M, double mu,
                                  const std::vector<int64_t>& permutation) {
  const std::lock_guard<std::mutex> lock(mumps_mutex());
  const Stopwatch clock;
  Triplets triplets = shifted_triplets(K, M, mu);
  Mumps mumps;
  auto& data = mumps.data();
  data.n = static_cast<MUMPS_INT>(K.rows());
  data.nnz = static_cast<MUMPS_INT8>(triplets.values.size());
  data.irn = triplets.rows.data();
  data.jcn = triplets.columns.data();
  data.a = triplets.values.data();
  analyse(mumps, permutation);
  factorise(mumps);
  InertiaCount count;
  count.negative = mumps.infog(12);
  count.zero = mumps.infog(28);
  count.by_mumps = true;
  count.seconds = clock.seconds();
  return count;
}

}  // namespace clatter::sparse
