// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Elastic bodies that move freely in space.
#include <Eigen/Core>
#include <string>

#include "core/rom/inertia_invariants.hpp"
#include "dynamics/body/rigid_body.hpp"

namespace clatter::dynamics {

/// An elastic body by displacement shapes u = N(x) q in a frame of its own. The frame is what the
/// shapes make it: fixed to nodes where they vanish, or the mean axes where they are orthogonal to
/// the rigid motions.
struct ElasticShapes {
  double mass = 0.0;  // [kg]
  Eigen::Vector3d centre =
      Eigen::Vector3d::Zero();        // of mass without deformation, in the frame [m]
  rom::InertiaInvariants invariants;  // by q, in the frame, n
  Eigen::MatrixXd stiffness;          // n x n, symmetric positive definite [N/m]
  Eigen::VectorXd damping;  // of the modes of the body, ascending in frequency, n [1/s]; empty: 0
};

/// Where it is at the start. `frame.centre` and `frame.velocity` are of the origin of the frame.
struct ElasticStart {
  SpatialMotion frame;
  Eigen::VectorXd q, rate;  // n; empty: zero
};

/// A floating body and the relation of its modes to its shapes: q = W eta.
struct FloatingBody {
  ModalBody body;          // coordinates: spatial_frame.hpp
  Eigen::Vector3d centre;  // of ElasticShapes
  Eigen::MatrixXd W;       // n x n
  Matrix3X mean;           // 3 x n: mean of N over the mass

  /// From the centre of mass to a point of the frame, without deformation [m].
  Eigen::Vector3d arm(const Eigen::Vector3d& point) const { return point - centre; }
  /// Displacement from the centre of mass by the modes, of a point with shapes N, 3 x n.
  Matrix3X shape(const Matrix3X& N) const;
};

/// The equations of the body about its centre of mass, to which its shapes are referred exactly:
/// N - mean. Its modes are those of the body with the frame's rotation held; the coupling with the
/// rotation is of SpinElement. NumericsError unless stiffness and mass are positive definite.
FloatingBody make_floating_body(const std::string& name, const ElasticShapes& shapes,
                                const ElasticStart& start);

/// The elastic modes of a free reduced body as shapes, in mean axes. @param free with its six rigid
/// modes. @param invariants of its reduced model. InputError when a rigid mode is missing or there
/// are no invariants.
ElasticShapes mean_axis_shapes(const ModalBody& free, const rom::InertiaInvariants& invariants);

}  // namespace clatter::dynamics
