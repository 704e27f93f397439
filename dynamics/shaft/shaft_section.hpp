// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sections and material of a shaft: inertia and flexibility of pieces of it.
#include <Eigen/Core>
#include <vector>

#include "dynamics/shaft/disc_body.hpp"

namespace clatter::dynamics {

struct ShaftMaterial {
  double youngs = 206e9, shear = 79.3e9;  // moduli [Pa]
  double density = 7850.0;                // [kg/m3]
  double shear_factor = 0.0;              // 0: by Cowper
};

/// A circular section, hollow where `inner` > 0, along a part of the axis.
struct ShaftSection {
  double from = 0.0, to = 0.0;      // along the axis [m]
  double outer = 0.0, inner = 0.0;  // diameters [m]
  double area() const;              // [m2]
  double second_moment() const;     // of area, about a diameter [m4]
  /// Timoshenko's shear factor: that of the material or, where it has none, of a hollow circle with
  /// its Poisson's ratio (Cowper 1966).
  double shear_factor(const ShaftMaterial& material) const;
};

/// What a piece of shaft adds to a disc; moments about its own centre of mass.
struct ShaftPiece {
  DiscInertia inertia;
  double centre = 0.0;  // of mass, along the axis [m]
};

/// Flexibility of a massless piece of shaft that is clamped at its lower end.
struct ShaftFlexibility {
  Eigen::Matrix2d bending;  // of (deflection, slope) at the upper end by (force, moment) there
  double torsion = 0.0;     // [rad/(N m)]
  double axial = 0.0;       // [m/N]
};

/// Sections one after the other, without gaps.
class ShaftSections {
 public:
  /// InputError unless each section begins where the one before ends.
  ShaftSections(std::vector<ShaftSection> sections, const ShaftMaterial& material);
  double begin() const { return sections_.front().from; }
  double end() const { return sections_.back().to; }
  const ShaftMaterial& material() const { return material_; }
  /// Mass and moments of the part between two positions.
  ShaftPiece piece(double from, double to) const;
  /// Timoshenko's beam of the part between two positions, from < to.
  ShaftFlexibility flexibility(double from, double to) const;

 private:
  template <class Visit>
  void visit(double from, double to, const Visit& visit) const;
  std::vector<ShaftSection> sections_;
  ShaftMaterial material_;
};

/// Both together as one rigid body.
ShaftPiece joined(const ShaftPiece& a, const ShaftPiece& b);

}  // namespace clatter::dynamics
