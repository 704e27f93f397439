// SPDX-License-Identifier: GPL-3.0-or-later
// Static mass of a reduced part by a complex step, as an oracle that shares no solver with the
// programs: with S(A) = A_bb - A_bi A_ii^{-1} A_ib,
//   S(K - i e M) = K_rr - i e M_rr + O(e^2)
// on the boundary coordinates, so -Im S / e has no cancellation however small e is (Squire and
// Trapp 1998; Leung 1978). One factorisation of MUMPS's complex version over all ranks.
//   mpirun -n 2 complex_step part.fe.h5 part.rom.h5 set ...
// prints the largest differences of K_rr and of M_rr from those of the file, over their largest
// entries.
#include <fmt/format.h>
#include <mpi.h>
#include <zmumps_c.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "condense/basis/dof_partition.hpp"
#include "core/base/error.hpp"
#include "core/rom/reduced_model.hpp"

namespace {

using clatter::condense::DofPartition;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kStep = 1e-10;  // e [1/s2]: e^2 terms are below 1e-20 of the entries
enum MumpsJob { kStart = -1, kEnd = -2, kAnalyseAndFactorise = 4 };

/// Entries of this rank, 1-based, the boundary last.
struct Triplets {
  std::vector<MUMPS_INT> rows, columns;
  std::vector<ZMUMPS_COMPLEX> values;
};

/// Every `ranks`-th entry of K - i e M, interior rows and columns scaled by K_jj^(-1/2), which
/// leaves S unchanged.
Triplets entries_of(const clatter::fe::FeModel& model, const DofPartition& dofs, int rank,
                    int ranks) {
  std::vector<MUMPS_INT> index(static_cast<size_t>(model.size()));
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(model.size());
  MUMPS_INT next = 0;
  for (const int32_t dof : dofs.interior) {
    index[dof] = ++next;
    scale[dof] = 1.0 / std::sqrt(model.K.coeff(dof, dof));
  }
  for (const int32_t dof : dofs.boundary) index[dof] = ++next;
  Triplets out;
  int64_t count = 0;
  const auto add = [&](const clatter::SparseMatrix& lower, double real, double imaginary) {
    for (int j = 0; j < lower.outerSize(); ++j)
      for (clatter::SparseMatrix::InnerIterator it(lower, j); it; ++it) {
        if (count++ % ranks != rank) continue;
        const double value = it.value() * scale[it.row()] * scale[j];
        out.rows.push_back(index[it.row()]);
        out.columns.push_back(index[j]);
        out.values.push_back({real * value, imaginary * value});
      }
  };
  add(model.K, 1.0, 0.0);
  add(model.M, 0.0, -kStep);
  return out;
}

/// S on rank 0, n_b x n_b.
Eigen::MatrixXcd schur_complement(Triplets& triplets, Index size, Index boundary, int rank) {
  ZMUMPS_STRUC_C mumps{};
  mumps.par = 1;
  mumps.sym = 2;  // complex symmetric
  mumps.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(MPI_COMM_WORLD));
  mumps.job = kStart;
  zmumps_c(&mumps);
  const auto control = [&](int i) -> MUMPS_INT& { return mumps.icntl[i - 1]; };
  for (int stream = 1; stream <= 3; ++stream) control(stream) = -1;
  control(4) = 0;
  control(14) = 100;  // [%] of more workspace
  control(18) = 3;    // entries are distributed
  control(19) = 1;    // Schur complement on rank 0, lower triangle by rows
  std::vector<MUMPS_INT> last(static_cast<size_t>(boundary));
  for (Index k = 0; k < boundary; ++k) last[k] = static_cast<MUMPS_INT>(size - boundary + k + 1);
  std::vector<ZMUMPS_COMPLEX> schur(rank == 0 ? static_cast<size_t>(boundary * boundary) : 0);
  mumps.n = static_cast<MUMPS_INT>(size);
  mumps.nnz_loc = static_cast<MUMPS_INT8>(triplets.values.size());
  mumps.irn_loc = triplets.rows.data();
  mumps.jcn_loc = triplets.columns.data();
  mumps.a_loc = triplets.values.data();
  mumps.size_schur = static_cast<MUMPS_INT>(boundary);
  mumps.listvar_schur = last.data();
  mumps.schur = schur.data();
  mumps.job = kAnalyseAndFactorise;
  zmumps_c(&mumps);
  const MUMPS_INT code = mumps.infog[0], detail = mumps.infog[1];
  mumps.job = kEnd;
  zmumps_c(&mumps);
  if (code < 0) throw clatter::NumericsError(fmt::format("zmumps: {}, {}", code, detail));
  Eigen::MatrixXcd S(boundary, boundary);
  for (Index row = 0; rank == 0 && row < boundary; ++row)
    for (Index column = 0; column <= row; ++column) {
      const ZMUMPS_COMPLEX& value = schur[row * boundary + column];
      S(row, column) = S(column, row) = {value.r, value.i};
    }
  return S;
}

double largest_difference(const MatrixXd& found, const MatrixXd& expected) {
  return (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  try {
    if (argc < 4) throw clatter::InputError("usage: complex_step part.fe.h5 part.rom.h5 set ...");
    const clatter::fe::FeModel model = clatter::fe::read_fe_model(argv[1]);
    const DofPartition dofs = clatter::condense::partition_dofs(model, {argv + 3, argv + argc});
    Triplets triplets = entries_of(model, dofs, rank, ranks);
    const auto boundary = static_cast<Index>(dofs.boundary.size());
    const Eigen::MatrixXcd S = schur_complement(triplets, model.size(), boundary, rank);
    if (rank == 0) {
      const clatter::rom::ReducedModel reduced = clatter::rom::read_reduced_model(argv[2]);
      fmt::print(
          "{:.3e} {:.3e}\n",
          largest_difference(reduced.K_rr.topLeftCorner(boundary, boundary), S.real()),
          largest_difference(reduced.M_rr.topLeftCorner(boundary, boundary), -S.imag() / kStep));
    }
  } catch (const clatter::Error& error) {
    fmt::print(stderr, "complex_step: {}\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(error.code()));
  }
  MPI_Finalize();
  return 0;
}
