// SPDX-License-Identifier: GPL-3.0-or-later
// [[beam]]: a stiffness and a mass between two points.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "assembly/recipe/resolve.hpp"
#include "core/base/error.hpp"
#include "core/fe/beam.hpp"

namespace clatter::assembly {
namespace {

constexpr double kParallel = 1e-6;  // sine of the angle between x and y

/// A beam's shear compliance 1/(k G A) along one axis.
double shear_compliance(const recipe::Beam& beam, const recipe::BeamSection& section, size_t axis) {
  if (beam.shear_factors.empty() || section.area == 0.0) return 0.0;
  return 1.0 / (beam.shear_factors[axis] * beam.G * section.area);
}

fe::BeamSection section_of(const recipe::Beam& beam, const recipe::BeamSection& section) {
  if (section.I12 * section.I12 > 0.0 && section.I12 * section.I12 >= section.I1 * section.I2)
    section.source.fail("I12", fmt::format("found {:g}, expected I12^2 below I1 I2", section.I12));
  if (section.J > 0.0 && beam.G == 0.0) beam.source.fail("G", "is missing, J needs it");
  return {.EA = beam.E * section.area,
          .GJ = beam.G * section.J,
          .EI1 = beam.E * section.I1,
          .EI2 = beam.E * section.I2,
          .EI12 = beam.E * section.I12,
          .shear1 = shear_compliance(beam, section, 0),
          .shear2 = shear_compliance(beam, section, 1),
          .mass = beam.rho * section.area + section.line_mass,
          .inertia1 = beam.rho * section.I1,
          .inertia2 = beam.rho * section.I2,
          .inertia12 = beam.rho * section.I12};
}

std::vector<fe::BeamStation> stations_of(const recipe::Beam& beam) {
  std::vector<fe::BeamStation> stations;
  for (const recipe::BeamSection& section : beam.sections) {
    const recipe::BeamSection& first = beam.sections.front();
    for (double recipe::BeamSection::*value : {&recipe::BeamSection::area, &recipe::BeamSection::I1,
                                               &recipe::BeamSection::I2, &recipe::BeamSection::J})
      if ((section.*value > 0.0) != (first.*value > 0.0))
        section.source.fail("at", fmt::format("found a section at {:g} that resists other motions "
                                              "than the first, expected the same",
                                              section.at));
    if (!stations.empty() && !(section.at > stations.back().at))
      section.source.fail("at", "expected sections from the first point to the second");
    stations.push_back({section.at, section_of(beam, section)});
  }
  if (stations.size() > 1 && (stations.front().at != 0.0 || stations.back().at != 1.0))
    beam.source.fail("sections", "found several, expected the first at 0 and the last at 1");
  return stations;
}

/// True when y and z can be exchanged by any rotation about x.
bool is_round(const std::vector<fe::BeamStation>& stations) {
  return std::ranges::all_of(stations, [](const fe::BeamStation& station) {
    const fe::BeamSection& s = station.section;
    return s.EI1 == s.EI2 && s.EI12 == 0.0 && s.shear1 == s.shear2;
  });
}

Eigen::Matrix3d axes_of(const recipe::Beam& beam, const Eigen::Vector3d& x, bool round) {
  Eigen::Matrix3d axes;
  axes.col(0) = x;
  const bool released = !beam.released_a.empty() || !beam.released_b.empty();
  if (!beam.y && (!round || released))
    beam.source.fail("y", "is missing, its section or releases need it");
  const Eigen::Vector3d y = beam.y.value_or(x.unitOrthogonal());
  const Eigen::Vector3d z = x.cross(y);
  if (!(z.norm() > kParallel))
    beam.source.fail("y", "is parallel to the beam, expected a direction across it");
  axes.col(2) = z.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// The matrix without rows of 0, also those that only rounding of the axes fills.
MatrixSpec spec_of(const std::string& name, const std::string& where, bool is_mass,
                   const std::vector<EquationSpec::Term>& terms, const fe::BeamMatrix& values) {
  constexpr double kNothing = 1e-24;  // of the largest: the square of a direction's rounding
  std::vector<int> rows;
  for (int i = 0; i < values.rows(); ++i) {
    double largest = 0.0;  // of displacements, or of rotations
    for (int k = 0; k < values.rows(); ++k)
      if (k / 3 % 2 == i / 3 % 2) largest = std::max(largest, std::abs(values(k, k)));
    if (std::abs(values(i, i)) > kNothing * largest) rows.push_back(i);
  }
  MatrixSpec spec{name, where, is_mass, {}, values(rows, rows)};
  for (const int i : rows) spec.terms.push_back(terms[i]);
  return spec;
}

/// The force along a beam in the state of [prestress] [N]; 0 without it.
double tension_of(const recipe::Beam& beam, const fe::BeamElement& element,
                  const std::optional<fe::Prestress>& state) {
  if (!state) return 0.0;
  Eigen::Vector<double, 12> u;
  for (size_t end = 0; end < 2; ++end) {
    const auto at = std::ranges::find(state->points, beam.points[end]);
    if (at == state->points.end())
      beam.source.fail("points",
                       fmt::format("found \"{}\", which the results of [prestress] do not "
                                   "have, expected those of a model with this beam",
                                   beam.points[end]));
    u.segment<6>(6 * static_cast<Eigen::Index>(end)) =
        state->point_motion.row(at - state->points.begin());
  }
  return state->factor * fe::beam_tension(element, u);
}

}  // namespace

void Resolver::beam(const recipe::Beam& beam, size_t number, Recipe& out) const {
  const std::string name = beam.name.empty() ? fmt::format("beam_{}", number) : beam.name;
  const std::string place = where(beam.source, "beam " + name);
  std::array<Eigen::Vector3d, 2> at;
  std::vector<EquationSpec::Term> terms;
  for (size_t end = 0; end < 2; ++end) {
    check_known(beam.source, "points", beam.points[end], names_.points);
    at[end] = std::ranges::find(out.points, beam.points[end], [](const PointSpec& one) {
                return one.point.name;
              })->point.position;
    for (int d = 0; d < 6; ++d)
      terms.push_back({Selection{{.point = beam.points[end]}, place}, d, 1.0});
  }
  fe::BeamElement element;
  element.offset = {beam.offset_a.value_or(Eigen::Vector3d::Zero()),
                    beam.offset_b.value_or(Eigen::Vector3d::Zero())};
  element.released = {beam.released_a, beam.released_b};
  element.stations = stations_of(beam);
  const Eigen::Vector3d x = at[1] + element.offset[1] - at[0] - element.offset[0];
  element.length = x.norm();
  if (!(element.length > 0.0))
    beam.source.fail("points", "found both ends at one place, expected a length");
  element.axes = axes_of(beam, x / element.length, is_round(element.stations));
  with_context(place, [&] {
    const double tension = tension_of(beam, element, out.prestress);
    out.matrices.push_back(
        spec_of(name, place, false, terms, fe::beam_stiffness(element, tension)));
    out.matrices.back().loss_factor = beam.loss_factor;
    const MatrixSpec mass = spec_of(name, place, true, terms, fe::beam_mass(element, out.mass));
    if (!mass.terms.empty()) out.matrices.push_back(mass);
  });
  if (out.matrices.back().terms.empty())
    beam.source.fail("sections", "found a section without area, I1, I2 and J, expected some");
}

}  // namespace clatter::assembly
