// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/exported_part.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::condense {
namespace {

using Kind = rom::MappedDof::Kind;

/// Values of the coordinates in SI that are 1 in `units`.
Eigen::VectorXd scale_of(const rom::ReducedModel& model, const UnitSystem& units) {
  const std::vector<rom::MappedDof> map = rom::map_of(model);
  Eigen::VectorXd scale(model.size());
  for (size_t j = 0; j < map.size(); ++j)
    scale[static_cast<Eigen::Index>(j)] = map[j].kind == Kind::kRotation ? 1.0
                                          : map[j].kind == Kind::kDisplacement
                                              ? units.length
                                              : units.length * std::sqrt(units.mass);
  return scale;
}

void convert(rom::InertiaInvariants& inertia, const Eigen::VectorXd& s, const UnitSystem& units) {
  if (inertia.empty()) return;
  const double moment = units.mass * units.length;
  for (Eigen::VectorXd& first : inertia.first) first = first.cwiseProduct(s) / moment;
  for (Eigen::VectorXd& one : inertia.moment) one = one.cwiseProduct(s) / (moment * units.length);
  for (Eigen::MatrixXd& product : inertia.product)
    product = s.asDiagonal() * product * s.asDiagonal() / (moment * units.length);
  inertia.place /= moment * units.length;
}

/// Two DoFs of one node, or one and the same.
bool belong_together(const rom::MappedDof& a, const rom::MappedDof& b) {
  return &a == &b || (a.component != 0 && b.component != 0 && a.of_deck == b.of_deck &&
                      a.turned == b.turned && a.position == b.position);
}

void check_numbers(const ExportedPart& part) {
  std::map<int, const rom::MappedDof*> known;
  for (const rom::MappedDof& dof : part.map) {
    const rom::MappedDof* other = known.try_emplace(dof.node, &dof).first->second;
    if (belong_together(*other, dof)) continue;
    throw InputError(fmt::format(
        "{}: number {}: found it for {} and {}, expected --first-grid and --first-spoint to leave "
        "each node its own, as {} does",
        part.model.name, dof.node, other->label, dof.label,
        rom::round_number_after(part.model.deck.largest_node)));
  }
}

/// A number below the highest of the deck may belong to a node that only the deck knows.
void warn_of_low_numbers(const ExportedPart& part) {
  const int32_t largest = part.model.deck.largest_node;
  for (const rom::MappedDof& dof : part.map)
    if (!dof.of_deck && dof.node <= largest) {
      warn(
          fmt::format("{}: new nodes begin at {}, but the deck has numbers up to {}: check that "
                      "none is used twice",
                      part.model.name, dof.node, largest));
      return;
    }
}

}  // namespace

rom::ReducedModel in_units(rom::ReducedModel model, const UnitSystem& units) {
  const Eigen::VectorXd s = scale_of(model, units);
  const double inertia = units.mass * units.length * units.length;
  const double energy = inertia / (units.time * units.time);
  model.K_rr = s.asDiagonal() * model.K_rr * s.asDiagonal() / energy;
  model.M_rr = s.asDiagonal() * model.M_rr * s.asDiagonal() / inertia;
  if (model.loss.rows() > 0) model.loss = s.asDiagonal() * model.loss * s.asDiagonal() / energy;
  model.alpha /= units.time;
  model.beta *= units.time;
  model.modal_damping.hz *= units.time;
  model.fixed_interface_hz *= units.time;
  model.valid_to_hz *= units.time;
  model.rigid = s.cwiseInverse().asDiagonal() * model.rigid;
  model.rigid.leftCols(3) *= units.length;
  for (auto& [name, set] : model.sets) set.position /= units.length;
  model.mass.mass /= units.mass;
  model.mass.centre /= units.length;
  model.mass.inertia /= inertia;
  convert(model.inertia, s, units);
  if (model.inertia_force.rows() > 0) {
    model.inertia_force = s.asDiagonal() * model.inertia_force / inertia;
    model.inertia_force.leftCols(3) *= units.length;
  }
  if (model.skin.nodes.rows() > 0) {
    model.skin.nodes /= units.length;
    model.skin.T = model.skin.T * s.asDiagonal() / units.length;
  }
  model.loads.clear();
  model.grids.clear();
  return model;
}

ExportedPart exported_part(const rom::ReducedModel& model, const UnitSystem& units,
                           const ExportOptions& options) {
  ExportedPart part{in_units(model, units), {}, units, options};
  part.map = rom::map_of(part.model, options.numbering);
  check_numbers(part);
  warn_of_low_numbers(part);
  return part;
}

std::string text_of(const UnitSystem& units) {
  return units.name == UnitSystem{}.name ? "SI: m, kg, s, N" : "units " + units.name;
}

}  // namespace clatter::condense
