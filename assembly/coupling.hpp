#pragma once
// Generalised coordinates q = C u: the motion of a reference node that rides on a face, the mean
// displacement of a face.
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assembly/surface_integral.hpp"
#include "core/h5_file.hpp"
#include "core/reduced_model.hpp"

namespace clatter::assembly {

/// One generalised coordinate: q = sum_k values[k] u[dofs[k]], nodal DoF = 3 node + direction.
struct Functional {
  std::vector<int32_t> dofs;
  std::vector<double> values;
};

/// Generalised coordinates that enter the model together.
struct Coupling {
  std::vector<Functional> rows;
  bool disjoint = false;  // no nodal DoF occurs in two rows
  DofSet set;             // one entry a row; `dofs` is filled by the elimination
};

/// The motion of a reference node at `point` (the centroid when absent) that fits the motion of a
/// face best (distributing coupling, RBE3):
///   minimise int |u(x) - (u_ref + theta x (x - point))|^2 dA   over u_ref, theta,
///   q_ref = A^-1 int R^T u dA,  A = int R^T R dA,  R = [I, -(x - point) x].
/// With u = sum N_a u_a the integrals are those of surface_integral.hpp. Rigid motions are
/// reproduced exactly; a force on q_ref is a traction on the face, linear in space, that adds
/// nothing to the face's stiffness (hard case B6: an RBE2 would).
/// `n_dofs` 6 (displacement, rotation) or 3 (displacement only). InputError, beginning with
/// `where`, when the face does not define a rotation (all nodes on a line).
Coupling distributing_coupling(const std::string& name, const std::string& kind,
                               const RowMatrix& coordinates, const SurfaceIntegrals& surface,
                               const std::optional<Eigen::Vector3d>& point, int n_dofs,
                               const std::string& where);

/// The mean displacement along `direction` (unit vector): q = (1/A) int direction . u dA.
/// `range`, when given, keeps the nodes whose coordinate along `direction` lies in it [m].
/// InputError, beginning with `where`, when no area remains.
Coupling mean_displacement(const std::string& name, const RowMatrix& coordinates,
                           const SurfaceIntegrals& surface, const Eigen::Vector3d& direction,
                           const std::optional<std::pair<double, double>>& range,
                           const std::string& where);

/// Unit rigid motions (x, y, z, rx, ry, rz about `point`) of the place `x`: 3 x 6, [I, -(x - p) x].
Eigen::Matrix<double, 3, 6> rigid_motion(const Eigen::Vector3d& x,
                                         const Eigen::Vector3d& point = Eigen::Vector3d::Zero());

}  // namespace clatter::assembly
