// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/loaded_body.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/rom/certificate_warning.hpp"

namespace clatter::dynamics {

LoadedBody make_loaded_body(const BodySpec& spec, rom::ReducedModel model) {
  LoadedBody body;
  body.spec = spec;
  body.model = std::move(model);
  body.modal = make_modal_body(body.model, {spec.elastic, spec.mode_limit_hz});
  body.modal.name = spec.name;
  body.modal.displacement_scale = spec.displacement_scale;
  body.modal.velocity_scale = spec.velocity_scale;
  body.sampled = body.modal.shapes;
  if (spec.motion == BodyMotion::kSpace) {
    body.shapes =
        with_context(spec.where, [&] { return mean_axis_shapes(body.modal, body.model.inertia); });
    const FloatingBody floating = make_floating_body(spec.name, *body.shapes, {});
    body.sampled = body.modal.shapes.rightCols(floating.W.rows()) * floating.W;
    body.first_sampled = kSpatial;
  }
  if (spec.motion == BodyMotion::kRod) {
    body.rod = with_context(spec.where, [&] { return make_elastic_rod(body.model, body.modal); });
    body.modal = body.rod->body;
    body.sampled = body.rod->shapes;
    body.first_sampled = kRodPlanar;
  }
  if (spec.motion == BodyMotion::kDrive && body.model.inertia.empty())
    throw InputError(
        fmt::format("{}: {}: found no inertia invariants, expected those of a frame that turns: "
                    "condense the part with inertia_invariants = true",
                    spec.where, spec.rom.string()));
  return body;
}

LoadedBody load_body(const BodySpec& spec) {
  rom::ReducedModel model = rom::read_reduced_model(spec.rom, false);
  const std::string warning = rom::certificate_warning(model);
  if (!warning.empty()) warn(fmt::format("{}: {}", spec.rom.string(), warning));
  LoadedBody body = make_loaded_body(spec, std::move(model));
  body.sha256 = sha256_of_file(spec.rom);
  return body;
}

const LoadedBody* find_body(const LoadedBodies& bodies, const std::string& name) {
  for (const auto& body : bodies) {
    if (body.spec.name == name) return &body;
  }
  return nullptr;
}

std::vector<int> set_dofs(const rom::ReducedModel& model, const std::string& set, int axis,
                          bool rotation) {
  const rom::DofSet& dofs = model.set(set);
  std::vector<int> found;
  for (size_t i = 0; i < dofs.dofs.size(); ++i) {
    // A direction within half a degree of the axis counts as the axis.
    const double along = dofs.direction(static_cast<Eigen::Index>(i), axis);
    if (std::abs(along) <= 0.99996 || (dofs.is_rotation[i] != 0) != rotation) continue;
    if (along < 0.0)
      throw InputError(
          fmt::format("{}: set \"{}\": {} points against {}, expected a set along the "
                      "axes: its direction or system in the fe.toml, reversed",
                      model.name, set, dofs.labels[i], "xyz"[axis]));
    found.push_back(dofs.dofs[i]);
  }
  if (!found.empty()) return found;
  constexpr size_t kShown = 12;  // two nodes; a grid has hundreds
  const size_t shown = std::min(kShown, dofs.labels.size());
  throw InputError(fmt::format(
      "{}: set \"{}\" has no {} {}, found: {}{}", model.name, set,
      rotation ? "rotation about" : "displacement along", "xyz"[axis],
      fmt::join(dofs.labels.begin(), dofs.labels.begin() + static_cast<std::ptrdiff_t>(shown),
                ", "),
      shown < dofs.labels.size() ? fmt::format(", ... ({} in all)", dofs.labels.size()) : ""));
}

int set_dof(const rom::ReducedModel& model, const std::string& set, int axis, bool rotation) {
  const std::vector<int> found = set_dofs(model, set, axis, rotation);
  if (found.size() == 1) return found.front();
  throw InputError(fmt::format("{}: set \"{}\" has {} {}s {} {}, expected one: a set of one node",
                               model.name, set, found.size(),
                               rotation ? "rotation" : "displacement", rotation ? "about" : "along",
                               "xyz"[axis]));
}

Node node_of(const rom::ReducedModel& model, const std::string& set) {
  const rom::DofSet& dofs = model.set(set);
  Node node{dofs.position.row(0), {}};
  for (int axis = 0; axis < 3; ++axis) node.dofs.push_back(set_dof(model, set, axis, false));
  bool turns = true;
  for (int axis = 0; axis < 3; ++axis) {
    bool found = false;
    for (size_t i = 0; i < dofs.dofs.size(); ++i)
      found = found || (dofs.is_rotation[i] != 0 &&
                        std::abs(dofs.direction(static_cast<Eigen::Index>(i), axis)) > 0.99996);
    turns = turns && found;
  }
  for (int axis = 0; turns && axis < 3; ++axis)
    node.dofs.push_back(set_dof(model, set, axis, true));
  return node;
}

const Eigen::VectorXd& unit_load(const rom::ReducedModel& model, const std::string& load) {
  const auto found = model.loads.find(load);
  if (found != model.loads.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : model.loads) names.push_back(entry.first);
  throw InputError(fmt::format("{}: no unit load \"{}\", found: {}", model.name, load,
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

}  // namespace clatter::dynamics
