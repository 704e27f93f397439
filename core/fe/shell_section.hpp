// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The section of a shell: what one metre of its width resists and weighs.
#include <Eigen/Core>

#include "core/fe/material.hpp"

namespace clatter::fe {

/// How a sheet of one material is made.
struct ShellSection {
  double thickness = 0.0;    // [m]
  double offset = 0.0;       // from the nodes to the mid-surface, along their directors [m]
  double bending = 1.0;      // bending stiffness over that of a plate: 12 I / t^3
  double shear = 5.0 / 6.0;  // k of the shear stiffness k G t
  double area_mass = 0.0;    // beside the material's [kg/m2]
};

/// Per width, in the axes of the cell (columns 11, 22, 12; shear strains and twists are
/// engineering's): N = A e + B k, m = B e + D k, q = S gamma.
struct ShellStiffness {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();  // [N/m]
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();  // [N]
  Eigen::Matrix3d D = Eigen::Matrix3d::Zero();  // [N m]
  Eigen::Matrix2d S = Eigen::Matrix2d::Zero();  // of 13, 23 [N/m]
  double drilling = 0.0;                        // [N/m]
  double mass = 0.0;                            // [kg/m2]
  double area_mass = 0.0;                       // of it, what the thickness does not scale
  double rotary = 0.0;                          // [kg]: rho t^3 / 12 and the like
};

/// Of a sheet of `thickness` [m] of an isotropic material under plane stress. The rotation about
/// the normal is tied to that of the membrane by 1e-4 G t: no digit of a result changes below it
/// (Hughes and Brezzi 1989).
ShellStiffness stiffness_of(const ShellSection& section, const Material& material,
                            double thickness);

}  // namespace clatter::fe
