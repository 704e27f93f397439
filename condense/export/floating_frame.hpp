// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Integrals over the mass of a part whose frame moves, in its elastic modes phi_k (Shabana, section
// 5.3; core/rom/inertia_invariants.hpp).
#include <Eigen/Core>

#include "condense/export/exported_part.hpp"
#include "condense/export/node_shapes.hpp"

namespace clatter::condense {

struct FloatingFrame {
  double mass = 0.0;
  Eigen::Vector3d centre;   // of mass
  Eigen::Matrix3d inertia;  // about the frame's origin
  Eigen::MatrixXd first;    // 3 x modes: of phi_k
  rom::InertiaInvariants invariants;

  Eigen::Index modes() const { return first.cols(); }
  /// Entry (l, m): integral of rho x_l phi_k,m.
  Eigen::Matrix3d moment(Eigen::Index k) const;
  /// Entry (l, m): integral of rho phi_k,l phi_i,m.
  Eigen::Matrix3d product(Eigen::Index k, Eigen::Index i) const;
};

/// InputError when the part has no inertia invariants, which `format` requires.
FloatingFrame floating_frame(const ExportedPart& part, const PencilModes& modes,
                             const std::string& format);

/// tilde(v) w = v x w.
Eigen::Matrix3d tilde(const Eigen::Vector3d& v);
/// a x b, from the matrix a b^T.
Eigen::RowVector3d axial(const Eigen::Matrix3d& S);

}  // namespace clatter::condense
