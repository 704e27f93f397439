// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sections of bars by their dimensions: area, moments of inertia, torsion constant. y and z are
// axes of symmetry, but of an I with unequal flanges, which is symmetric in z.
#include "core/recipe/recipe.hpp"

namespace clatter::mesh::deck {

using recipe::BeamSection;

BeamSection ring_section(double outer_radius, double inner_radius);

/// Torsion: S. Timoshenko, J. Goodier, "Theory of Elasticity", section 109, to 0.2 %.
BeamSection rectangle_section(double along_y, double along_z);

/// A closed box of outer size; its walls are `wall_y` thick where they bound it along y, `wall_z`
/// where along z. Torsion by Bredt's formula.
BeamSection box_section(double along_y, double along_z, double wall_y, double wall_z);

/// Two flanges across y and a web between them.
struct IShape {
  double height;            // along y
  double below, above;      // widths of the flanges, along z
  double web;               // its thickness, along z
  double t_below, t_above;  // thicknesses of the flanges, along y
};
/// About its centroid. Torsion: the sum of b t^3 / 3.
BeamSection i_section(const IShape& shape);

}  // namespace clatter::mesh::deck
