// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One instance of MUMPS over all ranks, and the matrix that it gets; for mumps_*.cpp only.
#include <dmumps_c.h>

#include <exception>
#include <string>
#include <vector>

#include "core/ranks/mumps_factor.hpp"

namespace clatter::ranks {

enum MumpsJob { kStart = -1, kEnd = -2, kAnalyse = 1, kFactorise = 2, kSolve = 3 };
enum class Definite { kYes, kNo };

/// A count of entries as MUMPS gives it in 32 bits: a negative one is in millions.
inline int64_t count_of(MUMPS_INT given) {
  return given < 0 ? -int64_t{1000000} * given : int64_t{given};
}

/// One instance; parameters are numbered as in MUMPS's guide.
class MumpsInstance {
 public:
  MumpsInstance(const Ranks& ranks, Definite definite) {
    data_.par = 1;
    data_.sym = definite == Definite::kYes ? 1 : 2;
    data_.comm_fortran = ranks.fortran_handle();
    run(kStart);
    for (int stream = 1; stream <= 3; ++stream) icntl(stream) = -1;
    icntl(4) = 0;
    icntl(5) = 0;   // entries, not elements
    icntl(6) = 0;   // keep the diagonal unpermuted
    icntl(7) = 1;   // the given order: with a Schur complement MUMPS's own has twice the flops
    icntl(8) = 0;   // scaled already
    icntl(12) = 1;  // plain ordering of the pattern
    icntl(18) = 3;  // entries are distributed
    icntl(28) = 1;  // one rank analyses the given order
  }
  /// While an error of this rank alone passes, the others do not end their instance.
  ~MumpsInstance() {
    if (std::uncaught_exceptions() == 0) end();
  }
  MumpsInstance(const MumpsInstance&) = delete;
  MumpsInstance& operator=(const MumpsInstance&) = delete;

  void run(MumpsJob job) {
    data_.job = job;
    dmumps_c(&data_);
  }
  void end() {
    if (!ended_) run(kEnd);
    ended_ = true;
  }
  MUMPS_INT& icntl(int i) { return data_.icntl[i - 1]; }
  MUMPS_INT infog(int i) const { return data_.infog[i - 1]; }
  int64_t count(int i) const { return count_of(infog(i)); }
  double rinfog(int i) const { return data_.rinfog[i - 1]; }
  DMUMPS_STRUC_C& data() { return data_; }

 private:
  DMUMPS_STRUC_C data_{};
  bool ended_ = false;
};

/// Lower triangle, 1-based.
struct Triplets {
  std::vector<MUMPS_INT> rows, columns;
  std::vector<double> values;
};

struct ScaledTriplets {
  Triplets triplets;
  Eigen::VectorXd scale;  // of the own rows
};

/// The scaled lower triangle of K - sigma M in the own rows, S as power_of_two_scale(K), 1 where
/// the diagonal is not positive. Boundary rows keep their unit where they are not eliminated.
ScaledTriplets scaled_triplets(const Ranks& ranks, const RowShares& shares,
                               const ShiftedEntries& from, Extent extent);

/// Gives the matrix, and its indices as the elimination order; both must outlive the instance.
void give_matrix(MumpsInstance& mumps, Triplets& triplets, std::vector<MUMPS_INT>& order,
                 int64_t size);

/// NumericsError where MUMPS cannot count the entries of the Schur complement in 32 bits.
void require_schur_counts(MumpsInstance& mumps, int64_t boundary);

/// Factorises; where the workspace predicted is too small it is raised and the step repeated.
void factorise(MumpsInstance& mumps, const std::string& what);

/// Ends the instance and throws what its code means: NotPositiveDefinite, NumericsError, FileError.
[[noreturn]] void fail(MumpsInstance& mumps, const std::string& what);

}  // namespace clatter::ranks
