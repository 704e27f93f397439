// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/units.hpp"

namespace clatter::mesh::deck {
namespace {

void convert_materials(Deck& deck, const UnitSystem& units) {
  for (auto& [name, material] : deck.materials) {
    material.density *= units.mass / (units.length * units.length * units.length);
    material.mass_damping /= units.time;
    material.stiffness_damping *= units.time;
    for (size_t i = 0; i < material.constants.size(); ++i) {
      const bool ratio = (material.kind == Material::Kind::kIsotropic && i == 1) ||
                         (material.kind == Material::Kind::kOrthotropic && i >= 3 && i <= 5);
      if (!ratio) material.constants[i] *= units.pressure();
    }
  }
}

/// A rotation in an equation is scaled by a length, so that sum c u remains a sum of lengths.
void convert_equations(Deck& deck, const UnitSystem& units) {
  for (Equation& equation : deck.equations)
    for (Equation::Term& term : equation.terms)
      if (term.direction >= 3) term.coefficient *= units.length;
}

/// Rows and columns of rotations have one more length; a mass has no other, a stiffness force over
/// length.
void convert_matrices(Deck& deck, const UnitSystem& units) {
  for (NodalMatrix& matrix : deck.matrices) {
    const double unit = matrix.is_mass ? units.mass : units.force() / units.length;
    for (size_t i = 0; i < matrix.terms.size(); ++i) {
      const double factor = matrix.terms[i].direction >= 3 ? units.length : 1.0;
      const auto row = static_cast<Eigen::Index>(i);
      matrix.values.row(row) *= factor * unit;
      matrix.values.col(row) *= factor;
    }
  }
}

void convert_beam(Beam& beam, const UnitSystem& units) {
  const double area = units.length * units.length;
  beam.E *= units.pressure();
  beam.G *= units.pressure();
  beam.rho *= units.mass / (area * units.length);
  for (auto* offset : {&beam.offset_a, &beam.offset_b})
    if (*offset) **offset *= units.length;
  for (recipe::BeamSection& section : beam.sections) {
    section.area *= area;
    for (double* moment : {&section.I1, &section.I2, &section.I12, &section.J})
      *moment *= area * area;
    section.line_mass *= units.mass / units.length;
  }
}

void convert_shells(Deck& deck, const UnitSystem& units) {
  for (recipe::Shell& shell : deck.shells) {
    shell.section.thickness *= units.length;
    shell.section.offset *= units.length;
    for (recipe::ShellLayer& layer : shell.layers) layer.thickness *= units.length;
    shell.section.area_mass *= units.mass / (units.length * units.length);
  }
  for (ShellBlock& block : deck.mesh.shells) {
    block.thickness *= units.length;
    block.offset *= units.length;
  }
}

bool is_rotation(const Support& support) { return (support.dofs & kTranslations) == 0; }

void convert_supports(std::vector<Support>& supports, const UnitSystem& units) {
  for (Support& support : supports)
    if (!is_rotation(support)) support.value *= units.length;
}

void convert_step(Step& step, const UnitSystem& units) {
  convert_supports(step.supports, units);
  convert_supports(step.moved, units);
  for (Step::NodalForce& force : step.forces)
    force.value *= units.force() * (force.direction >= 3 ? units.length : 1.0);
  for (Step::Pressure& pressure : step.pressures) pressure.value *= units.pressure();
  for (Step::Rotation& rotation : step.rotations) {
    rotation.omega_squared /= units.time * units.time;
    rotation.point *= units.length;
  }
  step.acceleration *= units.length / (units.time * units.time);
  step.accelerations *= units.length / (units.time * units.time);
}

}  // namespace

void convert_units(Deck& deck, const UnitSystem& units) {
  deck.mesh.nodes *= units.length;
  for (Point& point : deck.points) point.at *= units.length;
  for (auto& [name, system] : deck.systems) system.origin *= units.length;
  convert_materials(deck, units);
  convert_equations(deck, units);
  for (Tie& tie : deck.ties)
    if (tie.distance > 0.0) tie.distance *= units.length;
  for (Spring& spring : deck.springs) {
    const bool turns = spring.terms.front().direction >= 3;
    spring.stiffness *= units.force() * (turns ? units.length : 1.0 / units.length);
    for (Equation::Term& term : spring.terms)  // lever arms
      if (!turns && term.direction >= 3) term.coefficient *= units.length;
  }
  for (Beam& beam : deck.beams) convert_beam(beam, units);
  convert_shells(deck, units);
  for (Mass& mass : deck.masses) {
    mass.mass *= units.mass;
    mass.inertia *= units.mass * units.length * units.length;
    mass.offset *= units.length;
  }
  convert_matrices(deck, units);
  for (Damping& damping : deck.damping) {
    damping.mass /= units.time;
    damping.stiffness *= units.time;
  }
  convert_supports(deck.supports, units);
  for (Step& step : deck.steps) convert_step(step, units);
}

}  // namespace clatter::mesh::deck
