// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rigid-body motions left free by the supports, found from geometry before any eigenvalue solve.
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "core/fe/fe_model.hpp"

namespace clatter::fe {

/// Unconstrained rigid-body motions of each body: parts of a model that neither K nor M connects
/// move independently, and a free model of two parts has twelve.
struct FreeMotions {
  Eigen::MatrixXd q;        // n x m: motions in coordinates q, M-orthonormal
  Eigen::MatrixXd unit;     // 6 x m: as combinations of the unit motions x, y, z, rx, ry, rz
  std::vector<int> body;    // m: the body that moves
  int bodies = 0;           // of the model, free or held
  Eigen::Index moving = 0;  // free or held, with mass: six a body, three of a flat sheet's two

  Eigen::Index count() const { return q.cols(); }
  /// All bodies are completely free: no support, ground spring or constraint equation. A flat sheet
  /// counts as two bodies, which move in its plane and out of it.
  bool all_free() const { return bodies > 0 && count() == moving; }
};

/// A motion r is free when it needs no force to within rounding:
///   |K r|_i <= 1e-10 (|K| |r|)_i   for every row i,
/// The criterion depends on supports and geometry, not on frequencies: even a soft mount holds a
/// heavy body.
/// @param K, M n x n, symmetric, lower triangle. @param rigid n x 6, unit rigid-body motions.
FreeMotions free_motions(const SparseMatrix& K, const SparseMatrix& M,
                         const Eigen::MatrixXd& rigid);
/// The same by products, where no process has all of K and M.
struct RigidProducts {
  using Product = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& x)>;  // x is n x m
  std::vector<int> body;                                                     // n, as bodies_of
  Product mass, stiffness;
  Product magnitude;  // |K| |x|
};
FreeMotions free_motions(const RigidProducts& products, const Eigen::MatrixXd& rigid);
/// The same for a model with its supports: none if held, six if free.
FreeMotions free_motions(const fe::FeModel& model);

/// The free motions of a reduced model restricted to coordinates `left`, |left| x m, M-orthonormal:
/// those whose energy is rounding beside that of its stiffest coordinate.
Eigen::MatrixXd free_motions(const rom::ReducedModel& model, const std::vector<int32_t>& left);

/// Disjoint sets of DoFs (Tarjan's union-find with path halving).
class DofUnion {
 public:
  explicit DofUnion(Eigen::Index size);
  /// Members of `roots` with one value become one set.
  void join_all(const std::vector<int32_t>& roots);
  void join(int32_t i, int32_t j);
  /// The first DoF of the set of each DoF.
  std::vector<int32_t> roots();

 private:
  int32_t root(int32_t i);
  int32_t& above(int32_t i) { return above_[i]; }
  std::vector<int32_t> above_;
};

/// Sets numbered from 0, in the order of their first DoFs.
std::vector<int> numbered_sets(DofUnion& sets);

/// Zero-based body of each DoF: DoFs that neither K nor M connects belong to different bodies.
std::vector<int> bodies_of(const SparseMatrix& K, const SparseMatrix& M);

/// Half the diagonal of the part's bounding box [m], which makes rotations comparable to
/// translations.
double characteristic_length(const fe::FeModel& model);

/// "rotation about z" or "displacement along x": the dominant component of a motion (6). Rotations
/// about a far point look like displacements, so any motion with rotation is called a rotation.
std::string motion_name(const Eigen::VectorXd& motion, double length);

}  // namespace clatter::fe
