#pragma once
// The rigid motions that a model's supports leave free: known from its geometry, before any mode.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/fe/fe_model.hpp"

namespace clatter::fe {

/// Rigid motions that nothing holds, of each body by itself: parts of a model that neither K nor M
/// connects move independently, and a free model of two parts has twelve.
struct FreeMotions {
  Eigen::MatrixXd q;      // n x m: the motions as vectors of the model, M-orthonormal
  Eigen::MatrixXd unit;   // 6 x m: as combinations of the unit motions x, y, z, rx, ry, rz
  std::vector<int> body;  // m: the body that moves
  int bodies = 0;         // of the model, free or held

  Eigen::Index count() const { return q.cols(); }
  /// All bodies are wholly free: no support, no spring to the ground, no equation that holds them.
  bool all_free() const { return bodies > 0 && count() == 6 * bodies; }
};

/// A motion is free when it needs no force to rounding, row by row:
///   |K r|_i <= 1e-10 (|K| |r|)_i   for every row i,
/// a question about supports and geometry and none of frequencies: a soft mount on a heavy body
/// holds it.
/// @param K, M n x n, symmetric, lower triangle. @param rigid n x 6, unit rigid motions.
FreeMotions free_motions(const SparseMatrix& K, const SparseMatrix& M,
                         const Eigen::MatrixXd& rigid);
/// The same of a model on its own supports: none of a held one, six of a free one.
FreeMotions free_motions(const fe::FeModel& model);

/// The free motions of a reduced model with only the coordinates `left`, |left| x m, M-orthonormal;
/// rows of K_rr are measured by its diagonal, since what is zero in them is so to rounding.
Eigen::MatrixXd free_motions(const rom::ReducedModel& model, const std::vector<int32_t>& left);

/// The body that each unknown belongs to, counted from 0: unknowns that neither K nor M connects
/// are of different bodies.
std::vector<int> bodies_of(const SparseMatrix& K, const SparseMatrix& M);

/// Half the diagonal of the part's box [m]: distances of rotations are measured at this size.
double characteristic_length(const fe::FeModel& model);

/// "rotation about z" or "displacement along x": what a motion (6) mostly is. Rotations about a far
/// point look like displacements, so any turn at all is called a rotation.
std::string motion_name(const Eigen::VectorXd& motion, double length);

}  // namespace clatter::fe
