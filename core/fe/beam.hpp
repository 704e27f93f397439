// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Stiffness and mass of a straight beam between two nodes with six DoFs each: Timoshenko's theory,
// exact for loads at its ends.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/fe/material.hpp"

namespace clatter::fe {

/// A cross-section, about its centroid; x along the beam, y and z across. Where a stiffness is
/// zero, the beam does not resist: a truss has EA alone.
struct BeamSection {
  double EA = 0.0;                    // [N]
  double GJ = 0.0;                    // torsion [N m2]
  double EI1 = 0.0;                   // E int y^2 dA: bending in the plane x y [N m2]
  double EI2 = 0.0;                   // E int z^2 dA: bending in the plane x z [N m2]
  double EI12 = 0.0;                  // E int y z dA [N m2]
  double shear1 = 0.0, shear2 = 0.0;  // compliance along y, z: 1/(k G A) [1/N]; 0: rigid in shear
  double mass = 0.0;                  // [kg/m]
  double inertia1 = 0.0, inertia2 = 0.0, inertia12 = 0.0;  // rho int y^2, z^2, y z dA [kg m]
};

/// A section at a share of the length, from 0 to 1; linear between stations.
struct BeamStation {
  double at = 0.0;
  BeamSection section;
};

struct BeamElement {
  double length = 0.0;                                 // between its ends [m]
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns: x from end a to b, y, z
  std::vector<BeamStation> stations;                   // one: constant; else from 0 to 1
  std::array<Eigen::Vector3d, 2> offset{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<std::vector<int>, 2> released;  // of each end: 0 ... 5, x y z rx ry rz of `axes`
};

/// Rows and columns: x y z rx ry rz of node a, then of node b, in the frame of `axes`' entries.
using BeamMatrix = Eigen::Matrix<double, 12, 12>;

/// From the flexibility of the cantilever held at a, which needs no shape functions:
///   F = int A^T C^-1 A dx,  K_bb = F^-1,  u_b free = R u_a.
/// A: section forces by those at b, C: stiffness of the section. Ends that are away from their
/// nodes by `offset` [m] follow them like rigid arms. Released DoFs are those of the ends.
/// @return [N/m, N, N m]. InputError where the released DoFs leave a motion without stiffness.
/// Source: W. McGuire, R. H. Gallagher, R. D. Ziemian, "Matrix Structural Analysis", 2nd ed.,
/// chapters 4 and 13.
/// @param tension by which it is stiffer across: int N (v'^2 + w'^2) dx / 2 is added to its energy,
/// with the deflections of the same theory [N].
BeamMatrix beam_stiffness(const BeamElement& beam, double tension = 0.0);

/// The force along the beam when its nodes move by u: x y z rx ry rz of a, then of b [N].
double beam_tension(const BeamElement& beam, const Eigen::Vector<double, 12>& u);

/// Consistent: int N^T m N dx with the deflections N(x) of the same theory, and the rotary inertia
/// of the section; or the translations of the mass alone, shared by both ends as a lever shares it
/// (kHrz). @return [kg, kg m, kg m2].
BeamMatrix beam_mass(const BeamElement& beam, MassForm form);

}  // namespace clatter::fe
