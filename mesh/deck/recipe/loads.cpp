// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/recipe/loads.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
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

/// The text of one [[support]] or of a displacement load: target, directions, system.
std::string hold(const std::string& head, const std::string& target, DofMask dofs,
                 const Support& support) {
  return fmt::format(
      "\n{}{}directions = {}\n{}", head, target, toml_directions(dofs),
      support.system.empty() ? "" : fmt::format("system = {}\n", toml_text(support.system)));
}

class StepWriter {
 public:
  StepWriter(Deck& deck, RecipeNames& names, const Step& step)
      : deck_(deck), names_(names), step_(step) {}

  std::string write() {
    forces();
    for (const Step::Pressure& pressure : step_.pressures)
      add("pressure",
          fmt::format("kind = \"pressure\"\nsurface = {}\n", toml_text(pressure.surface)),
          pressure.value);
    const double acceleration = step_.acceleration.norm();
    if (acceleration > 0.0) {
      const Eigen::Vector3d along = step_.acceleration / acceleration;
      add("weight",
          fmt::format("kind = \"acceleration\"\ndirection = {}\n",
                      toml_list({along(0), along(1), along(2)})),
          acceleration);
    }
    if (step_.accelerations.size() > 0 && !step_.accelerations.isZero(0.0)) {
      const std::string name = step_.name + "_accelerations";
      deck_.mesh.fields[name] = step_.accelerations;
      add("acceleration", fmt::format("kind = \"acceleration\"\nfield = {}\n", toml_text(name)),
          1.0);
    }
    for (const Step::Rotation& one : step_.rotations) {
      std::vector<std::string> regions;
      for (const std::string& region : one.regions) regions.push_back(toml_text(region));
      add("rotation",
          fmt::format(
              "kind = \"centrifugal\"\naxis_point = {}\naxis = {}\n{}",
              toml_list({one.point(0), one.point(1), one.point(2)}),
              toml_list({one.axis(0), one.axis(1), one.axis(2)}),
              regions.empty() ? "" : fmt::format("regions = [{}]\n", fmt::join(regions, ", "))),
          one.omega_squared);
    }
    if (!step_.temperature.empty() && !expands())
      text_ += fmt::format("\n# {} ({}) has temperatures, and no material expands\n", step_.name,
                           step_.where);
    else if (!step_.temperature.empty())
      add("heat",
          fmt::format("kind = \"temperature\"\nfield = {}\nreference = {}\n",
                      toml_text(step_.temperature), reference_temperature()),
          1.0);
    displacements();
    if (factors_.empty()) return text_;
    return text_ + fmt::format("\n[[case]]\nname = {}\nloads = {{ {} }}\n", toml_text(step_.name),
                               fmt::join(factors_, ", "));
  }

 private:
  void add(const std::string& kind, const std::string& body, double factor) {
    const std::string name = fmt::format(
        "{}_{}{}", step_.name, kind, ++count_[kind] == 1 ? "" : fmt::format("_{}", count_[kind]));
    text_ += fmt::format("\n[[load]]\nname = {}\n{}", toml_text(name), body);
    factors_.push_back(fmt::format("{} = {}", toml_key(name), factor));
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
      const std::string point = names_.is_point(force.node_index)
                                    ? names_.point(force.node_index)
                                    : names_.point_on_node(force.node_index);
      auto [at, fresh] = on_points.try_emplace(point);
      if (fresh) at->second = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
      (moment ? at->second.second : at->second.first) += value;
    }
    if (!field.isZero(0.0)) {
      const std::string name = step_.name + "_forces";
      deck_.mesh.fields[name] = field;
      add("forces", fmt::format("kind = \"nodal\"\nfield = {}\n", toml_text(name)), 1.0);
    }
    for (const auto& [point, vectors] : on_points) {
      const auto& [force, moment] = vectors;
      if (force.isZero(0.0) && moment.isZero(0.0)) continue;
      add("force",
          fmt::format("kind = \"force\"\nset = {}\nforce = {}\nmoment = {}\n", toml_text(point),
                      toml_list({force(0), force(1), force(2)}),
                      toml_list({moment(0), moment(1), moment(2)})),
          1.0);
    }
  }

  void displacements() {
    const auto prescribe = [&](const Support& support, DofMask part, const std::string& target) {
      if (part == 0) return;
      std::string body = fmt::format("kind = \"displacement\"\n{}directions = {}\nvalue = {}\n",
                                     target, toml_directions(part), support.value);
      if (!support.system.empty()) body += fmt::format("system = {}\n", toml_text(support.system));
      add("displacement", body, 1.0);
    };
    std::vector<const Support*> all;
    for (const Support& support : deck_.supports) all.push_back(&support);
    for (const auto* of_step : {&step_.supports, &step_.moved})
      for (const Support& support : *of_step) all.push_back(&support);
    for (const Support* support : all) {
      if (support->value == 0.0) continue;
      const NamedNodes named = names_.node_indices(support->node_indices, set_name(*support));
      if (!named.node_set.empty())
        prescribe(*support, support->dofs & kTranslations,
                  fmt::format("node_set = {}\n", toml_text(named.node_set)));
      for (const std::string& point : named.points) {
        const std::string target = fmt::format("point = \"{}\"\n", point);
        prescribe(*support, support->dofs & kTranslations, target);
        prescribe(*support, static_cast<DofMask>(support->dofs & ~kTranslations), target);
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
  std::string text_;
  std::vector<std::string> factors_;
  std::map<std::string, int> count_;
};

}  // namespace

std::string support_text(const Support& support, RecipeNames& names) {
  const NamedNodes named = names.node_indices(support.node_indices, set_name(support));
  std::string out;
  const DofMask shifts = support.dofs & kTranslations;
  if (!named.node_set.empty() && shifts != 0)
    out += hold("[[support]]\n", fmt::format("node_set = {}\n", toml_text(named.node_set)), shifts,
                support);
  for (const std::string& point : named.points)
    out += hold("[[support]]\n", fmt::format("point = \"{}\"\n", point), support.dofs, support);
  return out;
}

std::string write_steps(Deck& deck, RecipeNames& names) {
  std::string out;
  const Step* first = nullptr;
  for (const Step& step : deck.steps) {
    if (first == nullptr) {
      first = &step;
      for (const Support& support : step.supports) out += support_text(support, names);
    }
    if (!same_supports(*first, step)) {
      out += fmt::format("\n# {} ({}) has other supports than {}: it needs a separate model\n",
                         step.name, step.where, first->name);
      continue;
    }
    out += StepWriter(deck, names, step).write();
  }
  return out;
}

}  // namespace clatter::mesh::deck
