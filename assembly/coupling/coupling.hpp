// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Generalised coordinates q = C u: the motion of a reference node coupled to a face, the mean
// displacement of a face.
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assembly/surface/surface_integral.hpp"
#include "core/base/matrix.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// One generalised coordinate: q = sum_k values[k] u[dofs[k]], nodal DoF = 3 node + direction.
struct Functional {
  std::vector<int32_t> dofs;
  std::vector<double> values;
};

/// Generalised coordinates added to the model together.
///
/// A row over a large face would couple all displacements of the face with one another in K and M.
/// So large faces are coupled in two steps: `means` are mean displacements of groups of nodes,
/// which become coordinates too, and `rows` combine these few. Entries are then added within groups
/// and among group means only.
struct Coupling {
  std::vector<Functional> rows;   // on nodal DoFs; on the means' numbers when there are means
  std::vector<Functional> means;  // on nodal DoFs, no DoF in two of them
  bool disjoint = false;          // no nodal DoF occurs in two rows
  rom::DofSet set;                // one entry a row; `dofs` is filled by the elimination

  /// The rows in terms of nodal DoFs.
  std::vector<Functional> nodal_rows() const;
};

/// Faces with more nodes than this are coupled in two steps, in groups of at most kGroupNodes
/// nodes.
inline constexpr size_t kLargeFace = 100;
inline constexpr size_t kGroupNodes = 24;

struct Member;

/// Rows q = C u for `directions` (0 ... 5: x y z rx ry rz) of a reference node at `point` that fits
/// the motion of the members best (RBE3):
///   minimise sum_p W_p sum_d (u_pd - (R_p q)_d)^2,  d the DoFs of member p in the coupling,
///   C = A^-1 [W_p R_p^T ...],  A = sum_p W_p R_p^T R_p,  R = [I, -(x - point) x].
/// A rotation of a member has the weight W_p L^2, L the members' root mean square distance from
/// their centre. Large faces use group means. The caller fills the coupling's set. InputError,
/// beginning with `where`, when the members do not define one of the directions.
Coupling distribute(const std::vector<Member>& members, const Eigen::Vector3d& point,
                    const std::vector<int>& directions, const std::string& where);

/// Labels, position and directions of a reference node's coordinates; no dofs yet.
rom::DofSet reference_set(const std::string& name, const std::string& kind,
                          const Eigen::Vector3d& point, const std::vector<int>& directions);

/// The motion of a reference node at `point` (the centroid when absent) that fits the motion of a
/// face best (distributing coupling, RBE3):
/// distribute() with the nodes of the face and their consistent areas W_p = int N_p dA; on a large
/// face groups of nodes with area-weighted means u_p, R_p. Rigid motions are reproduced exactly; a
/// force on q_ref is distributed over the face as a traction and adds no stiffness (hard case B6:
/// an RBE2 would). `n_dofs` 6 (displacement, rotation) or 3 (displacement only). InputError,
/// beginning with `where`, when the face does not define a rotation (all nodes on a line).
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

/// Unit rigid motions (x, y, z, rx, ry, rz about `point`) at position `x`: 3 x 6, [I, -(x - p) x].
Eigen::Matrix<double, 3, 6> rigid_motion(const Eigen::Vector3d& x,
                                         const Eigen::Vector3d& point = Eigen::Vector3d::Zero());

}  // namespace clatter::assembly
