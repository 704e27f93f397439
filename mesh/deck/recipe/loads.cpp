// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/recipe/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "mesh/deck/system_axes.hpp"

namespace clatter::mesh::deck {
namespace {

std::string set_name(const Support& support) {
  return support.name.empty() ? "support" : support.name;
}

/// The same nodes and directions, whatever the value.
bool same_hold(const Support& a, const Support& b) {
  return a.node_indices == b.node_indices && a.dofs == b.dofs && a.system == b.system;
}

bool same_supports(const Step& a, const Step& b) {
  return std::equal(a.supports.begin(), a.supports.end(), b.supports.begin(), b.supports.end(),
                    same_hold);
}

using Kind = recipe::Load::Kind;

class StepLoads {
 public:
  StepLoads(Deck& deck, RecipeNames& names, const Step& step, Recipe& recipe)
      : deck_(deck), names_(names), step_(step), recipe_(recipe) {}

  void add_all() {
    forces();
    for (const Step::Pressure& pressure : step_.pressures)
      add("pressure", Kind::kPressure, pressure.value).selection.surface = pressure.surface;
    if (const double acceleration = step_.acceleration.norm(); acceleration > 0.0)
      add("weight", Kind::kAcceleration, acceleration).direction =
          step_.acceleration / acceleration;
    if (step_.accelerations.size() > 0 && !step_.accelerations.isZero(0.0)) {
      const std::string name = step_.name + "_accelerations";
      deck_.mesh.fields[name] = step_.accelerations;
      add("acceleration", Kind::kAcceleration).field = name;
    }
    for (const Step::Rotation& one : step_.rotations) {
      recipe::Load& load = add("rotation", Kind::kCentrifugal, one.omega_squared);
      load.axis = {one.point, one.axis};
      load.regions = one.regions;
    }
    if (!step_.temperature.empty() && !expands()) {
      recipe_.remarks.push_back(fmt::format("{} ({}) has temperatures, and no material expands",
                                            step_.name, step_.where));
    } else if (!step_.temperature.empty()) {
      recipe::Load& load = add("heat", Kind::kTemperature);
      load.field = step_.temperature;
      load.reference = reference_temperature();
    }
    displacements();
    if (!sum_.factors.empty()) recipe_.file.cases.push_back(sum_);
  }

 private:
  /// The next load of the step, with its factor in the case.
  recipe::Load& add(const std::string& name, Kind kind, double factor = 1.0) {
    recipe::Load& load = recipe_.file.loads.emplace_back();
    const int count = ++count_[name];
    load.source = keys::Source(step_.where);
    load.name = count == 1 ? fmt::format("{}_{}", step_.name, name)
                           : fmt::format("{}_{}_{}", step_.name, name, count);
    load.kind = kind;
    sum_.factors[load.name] = factor;
    return load;
  }

  Eigen::Vector3d direction(const Step::NodalForce& force) const {
    for (const Bolt& bolt : deck_.bolts)
      if (bolt.reference == force.node_index) return bolt.direction;
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(force.direction % 3);
    if (force.system.empty()) return unit;
    const System& system = deck_.systems.at(force.system);
    const Eigen::Vector3d at = names_.is_point(force.node_index)
                                   ? deck_.points[force.node_index - deck_.mesh.nodes.rows()].at
                                   : Eigen::Vector3d(deck_.mesh.nodes.row(force.node_index));
    return axes_at(system, at) * unit;
  }

  void forces() {
    RowMatrix field = RowMatrix::Zero(deck_.mesh.nodes.rows(), 3);
    std::map<std::string, std::pair<Eigen::Vector3d, Eigen::Vector3d>> on_points;
    for (const Step::NodalForce& force : step_.forces) {
      const Eigen::Vector3d value = force.value * direction(force);
      const bool moment = force.direction >= 3;
      if (!names_.is_point(force.node_index) && !moment) {
        field.row(force.node_index) += value.transpose();
        continue;
      }
      const std::string point = names_.reference(force.node_index);
      auto [at, fresh] = on_points.try_emplace(point);
      if (fresh) at->second = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
      (moment ? at->second.second : at->second.first) += value;
    }
    if (!field.isZero(0.0)) {
      const std::string name = step_.name + "_forces";
      deck_.mesh.fields[name] = field;
      add("forces", Kind::kNodal).field = name;
    }
    for (const auto& [point, vectors] : on_points) {
      const auto& [force, moment] = vectors;
      if (force.isZero(0.0) && moment.isZero(0.0)) continue;
      recipe::Load& load = add("force", Kind::kForce);
      load.set = point;
      load.force = force;
      load.moment = moment;
    }
  }

  void displacements() {
    const auto prescribe = [&](const Support& support, int part,
                               const recipe::Selection& selection) {
      if (part == 0) return;
      recipe::Load& load = add("displacement", Kind::kDisplacement);
      load.selection = selection;
      load.directions = directions_of(static_cast<DofMask>(part));
      load.value = support.value;
      load.system = support.system;
    };
    std::vector<const Support*> all;
    for (const Support& support : deck_.supports) all.push_back(&support);
    for (const auto* of_step : {&step_.supports, &step_.moved})
      for (const Support& support : *of_step) all.push_back(&support);
    for (const Support* support : all) {
      if (support->value == 0.0) continue;
      for (const auto& [mask, some] : names_.by_directions(support->node_indices, support->dofs)) {
        const NamedNodes named = names_.node_indices(some, set_name(*support));
        for (const int part : {mask & kTranslations, mask & ~kTranslations}) {
          if (!named.node_set.empty()) prescribe(*support, part, {.node_set = named.node_set});
          for (const std::string& point : named.points) prescribe(*support, part, {.point = point});
        }
      }
    }
  }

  bool expands() const {
    return std::any_of(deck_.materials.begin(), deck_.materials.end(), [](const auto& named) {
      const std::vector<double>& alpha = named.second.expansion;
      return std::any_of(alpha.begin(), alpha.end(), [](double value) { return value != 0.0; });
    });
  }

  /// Reference temperature of the materials with expansion; it must be the same for all.
  double reference_temperature() const {
    double reference = 0.0;
    const Material* first = nullptr;
    for (const auto& [name, material] : deck_.materials) {
      if (material.expansion.empty()) continue;
      if (first != nullptr && material.reference_temperature != reference)
        throw InputError(fmt::format(
            "{}: material {} has the reference temperature {:g}, {} (line {}) has {:g}: expected "
            "the same for all",
            material.where, name, material.reference_temperature, first->name, first->where,
            reference));
      reference = material.reference_temperature;
      first = &material;
    }
    return reference;
  }

  Deck& deck_;
  RecipeNames& names_;
  const Step& step_;
  Recipe& recipe_;
  recipe::Case sum_{.source = keys::Source(step_.where), .name = step_.name, .factors = {}};
  std::map<std::string, int> count_;
};

}  // namespace

void add_support(const Support& support, RecipeNames& names, recipe::File& file) {
  for (const auto& [mask, some] : names.by_directions(support.node_indices, support.dofs)) {
    const NamedNodes named = names.node_indices(some, set_name(support));
    const auto add = [&, dofs = mask](const recipe::Selection& selection) {
      file.supports.push_back({.source = keys::Source(support.where),
                               .selection = selection,
                               .directions = directions_of(dofs),
                               .system = support.system});
    };
    if (!named.node_set.empty()) add({.node_set = named.node_set});
    for (const std::string& point : named.points) add({.point = point});
  }
}

void add_steps(Deck& deck, RecipeNames& names, Recipe& recipe) {
  const Step* first = nullptr;
  for (const Step& step : deck.steps) {
    if (first == nullptr) {
      first = &step;
      for (const Support& support : step.supports) add_support(support, names, recipe.file);
    }
    if (same_supports(*first, step))
      StepLoads(deck, names, step, recipe).add_all();
    else {
      recipe.remarks.push_back(
          fmt::format("{} ({}) has other supports than {}: it needs a separate model", step.name,
                      step.where, first->name));
      warn(
          fmt::format("{}: {} has other supports than {} and is left out: it needs a model of its "
                      "own, with its [[support]] tables",
                      step.where, step.name, first->name));
    }
  }
}

}  // namespace clatter::mesh::deck
