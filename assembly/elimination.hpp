#pragma once
// Puts generalised coordinates into the model in the place of nodal displacements, and takes
// supported displacements out.
//
// For a coupling q = C u as many pivot displacements are chosen as it has rows (column-pivoted QR
// of C; a displacement is a pivot at most once) and expressed by
//   u_piv = C_piv^-1 (q - C_rest u_rest),
// which gives u = T q, K' = T^T K T, M' = T^T M T, f' = T^T f. No displacement pattern is lost, so
// K' and M' describe the same body, stay as definite as before, and recovery is exact.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "assembly/coupling.hpp"
#include "core/sparse.hpp"

namespace clatter::assembly {

/// The transformation from all nodal displacements to the model's coordinates: first the nodal
/// displacements that remain, in their old order, then the generalised ones in order of addition
/// (means of groups that gave way to a coupling's rows are gone).
struct Elimination {
  SparseMatrix T;                   // 3 n_nodes x n
  std::vector<int32_t> reduced_of;  // coordinate of id 0 ... 3 n_nodes - 1 (displacements) and
                                    // 3 n_nodes + g (generalised), or -1
  std::vector<int32_t> pivots;      // displacements that gave way, ascending
  SparseMatrix pivot_rows;          // pivots x n: their rows of T
  double growth = 1.0;              // largest |entry| of T that multiplies a displacement

  int size() const { return static_cast<int>(T.cols()); }
};

/// Collects supports and couplings, then builds the transformation.
class Eliminator {
 public:
  /// `n_dofs` nodal displacements; `fixed` are zero and leave the model; `kept` stay coordinates
  /// (sensors, plain nodes) and are never pivots.
  Eliminator(int64_t n_dofs, const std::vector<int32_t>& fixed, const std::vector<int32_t>& kept);

  /// Adds a coupling: its means, then its rows, which get the next generalised numbers g in this
  /// order; returns the number of its first row. InputError,
  /// beginning with `where`, when its rows depend on supports or earlier couplings, or when it
  /// would fill the matrices beyond 32-bit indices.
  int add(const Coupling& coupling, const std::string& where);

  Elimination finish() const;

 private:
  using SparseRow = std::vector<std::pair<int32_t, double>>;  // ids ascending; q_g is n_dofs_ + g

  SparseRow expand(const Functional& functional);
  void add_mean(const Functional& mean, const std::string& where);
  void eliminate(const std::vector<Functional>& functionals, int32_t state,
                 const std::string& where);
  std::vector<int32_t> choose_pivots(const Eigen::MatrixXd& C, const std::vector<int32_t>& ids,
                                     const std::string& where) const;
  void substitute(const std::vector<int32_t>& fresh);
  SparseRow gather();

  int64_t n_dofs_;
  int64_t fill_ = 0;  // entries that the couplings may add to K
  int generalised_ = 0;
  std::vector<int32_t> state_;       // per id: kFree, kKept, kFixed or pivot number
  std::vector<int32_t> pivot_dofs_;  // by pivot number
  std::vector<SparseRow> pivot_rows_;
  std::vector<double> sum_;  // scatter space of expand()
  std::vector<int32_t> touched_;
};

/// Replaces symmetric A (lower triangle) by T^T A T (lower triangle).
void transform(SparseMatrix& lower, const Elimination& elimination);

}  // namespace clatter::assembly
