// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A material in a sheet: plane stress in its plane, transverse shear beside it.
#include <Eigen/Core>

#include "core/fe/material.hpp"

namespace clatter::fe {

/// In two directions of the sheet's plane.
struct SheetLaw {
  Eigen::Matrix3d plane;      // stresses 11 22 12 by strains, engineering shear [Pa]
  Eigen::Matrix2d shear;      // stresses 13 23 by engineering shear strains [Pa]
  Eigen::Vector3d expansion;  // strains 11 22 12 (engineering) per kelvin [1/K]
};

/// Whether transverse shear is apart from what happens in the plane of directions 1 and 2, as in
/// every isotropic or orthotropic material.
bool is_sheet_material(const Material& material);

/// The law in directions that are turned by -angle from those of the material: its direction 1 is
/// at `angle` [rad] from the first, right-handed about direction 3. The material's `axes` are not
/// used.
SheetLaw sheet_law(const Material& material, double angle = 0.0);

}  // namespace clatter::fe
