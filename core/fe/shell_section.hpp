// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The section of a shell: what one metre of its width resists and weighs.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/fe/axes.hpp"
#include "core/fe/material.hpp"
#include "core/fe/sheet_law.hpp"

namespace clatter::fe {

/// A ply of a laminate.
struct ShellLayer {
  Material material{};
  double thickness = 0.0;  // [m]
  double angle = 0.0;      // of the material's direction 1 from that of the sheet [rad]
};

/// How a sheet of one material is made, or of layers.
struct ShellSection {
  double thickness = 0.0;    // [m]; that of all layers
  double offset = 0.0;       // from the nodes to the mid-surface, along their directors [m]
  double bending = 1.0;      // bending stiffness over that of a plate: 12 I / t^3
  double shear = 5.0 / 6.0;  // k of the shear stiffness k G t
  double area_mass = 0.0;    // beside the material's [kg/m2]
  std::optional<Material> bending_material = {};  // that resists bending, if another one does
  std::optional<Material> shear_material = {};    // likewise of transverse shear
  std::vector<ShellLayer> layers = {};            // from the inner side to the outer one; or none
  std::optional<Axes> axes = {};  // direction 1 of the sheet is their first, projected;
                                  // absent: the first side of each cell
  /// Whether it matters where direction 1 is.
  bool has_directions(const Material& material) const;
};

/// Per area.
struct ShellMass {
  double total = 0.0;      // [kg/m2]
  double area_mass = 0.0;  // of it, what the thickness does not scale
  double moment = 0.0;     // int rho z dz [kg/m]
  double rotary = 0.0;     // int rho z^2 dz [kg]
};

/// Per width, in the axes of the cell (columns 11, 22, 12; shear strains and twists are
/// engineering's): N = A e + B k, m = B e + D k, q = S gamma.
struct ShellStiffness {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();        // [N/m]
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();        // [N]
  Eigen::Matrix3d D = Eigen::Matrix3d::Zero();        // [N m]
  Eigen::Matrix2d S = Eigen::Matrix2d::Zero();        // of 13, 23 [N/m]
  double drilling = 0.0;                              // [N/m]
  Eigen::Vector3d stretch = Eigen::Vector3d::Zero();  // e of a free sheet per kelvin [1/K]
  Eigen::Vector3d curl = Eigen::Vector3d::Zero();     // k of it [1/(m K)]
  ShellMass mass;

  bool expands() const { return !stretch.isZero(0.0) || !curl.isZero(0.0); }
};

/// Of a sheet of `thickness` [m], its layers in proportion, under plane stress. The rotation about
/// the normal is tied to that of the membrane by 1e-4 of A for shear: no digit of a result changes
/// below it (Hughes and Brezzi 1989). The transverse shear of layers has the energy of the shear
/// stresses that balance those of bending to a cylinder, along either direction (Rohwer 1988): 5/6
/// G t of one material.
ShellStiffness stiffness_of(const ShellSection& section, const Material& material,
                            double thickness);

/// Likewise its mass.
ShellMass mass_of(const ShellSection& section, const Material& material, double thickness);

/// The laws of the layers at the faces of the sheet.
struct FaceLaws {
  SheetLaw inner, outer;
};
FaceLaws face_laws(const ShellSection& section, const Material& material);

}  // namespace clatter::fe
