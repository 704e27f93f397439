// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/model_builder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {

ModelBuilder::ModelBuilder(const LoadedBodies& bodies, const TimeSpec& span,
                           const std::optional<CrankClock>& crank)
    : loaded(bodies), time(span), clock(crank) {
  for (const LoadedBody& one : loaded) index_[one.spec.name] = system.add_body(one.modal);
}

int ModelBuilder::add_body(ModalBody body, const std::string& where) {
  const std::string name = body.name;
  if (has_body(name))
    throw InputError(
        fmt::format("{}: a second body named \"{}\", expected each name once", where, name));
  return index_[name] = system.add_body(std::move(body));
}

void ModelBuilder::add_ports(const std::string& body, PortMaker maker, const std::string& where) {
  if (!ports_.emplace(body, std::move(maker)).second || find_body(loaded, body) != nullptr)
    throw InputError(
        fmt::format("{}: a second body named \"{}\", expected each name once", where, body));
}

const TurningBody& ModelBuilder::turn(const std::string& name, const std::string& where) const {
  const auto found = turns_.find(name);
  if (found == turns_.end())
    throw InputError(fmt::format("{}: no body \"{}\" that turns about an axis, found: {}", where,
                                 name, names_of(turns_)));
  return found->second;
}

int ModelBuilder::y(const std::string& body, const std::string& set, int axis, bool rotation) {
  return system.coordinate(index_.at(body),
                           set_dof(find_body(loaded, body)->model, set, axis, rotation));
}

Eigen::Vector3d ModelBuilder::position(const PointSpec& point,
                                       const std::optional<Eigen::Vector3d>& fallback) const {
  if (point.at) return *point.at;
  if (!point.set.empty()) {
    const LoadedBody* body = find_body(loaded, point.body);
    if (body == nullptr)
      throw InputError(fmt::format("{}.set: no body \"{}\" with a reduced model in the scene",
                                   point.where, point.body));
    return body->model.set(point.set).position.row(0);
  }
  if (fallback) return *fallback;
  throw InputError(point.where + ": found no point, expected at_mm, or set of a reduced model");
}

std::unique_ptr<Port> ModelBuilder::port(const PointSpec& point,
                                         const std::optional<Eigen::Vector3d>& fallback) {
  if (const LoadedBody* body = find_body(loaded, point.body)) return node_port(*body, point);
  const Eigen::Vector3d at = position(point, fallback);
  if (point.body.empty()) return std::make_unique<GroundPort>(at);
  const auto found = ports_.find(point.body);
  if (found == ports_.end())
    throw InputError(fmt::format("{}.body: no body \"{}\" in the scene, found: {}", point.where,
                                 point.body, names_of(ports_)));
  return found->second(system, at);
}

std::unique_ptr<Port> ModelBuilder::node_port(const LoadedBody& body, const PointSpec& point) {
  if (moving_.count(point.body) != 0)
    throw InputError(
        fmt::format("{}.body: the frame of \"{}\" follows its cylinder: no element "
                    "acts on points of it",
                    point.where, point.body));
  if (point.set.empty())
    throw InputError(
        fmt::format("{}.set: found nothing, expected a set of the reduced model of "
                    "\"{}\"",
                    point.where, point.body));
  const rom::DofSet& set = body.model.set(point.set);
  std::vector<int> coordinates;
  for (int axis = 0; axis < 3; ++axis) coordinates.push_back(y(point.body, point.set, axis, false));
  bool turns = true;
  for (int axis = 0; axis < 3; ++axis) {
    bool found = false;
    for (size_t i = 0; i < set.dofs.size(); ++i)
      found = found || (set.is_rotation[i] != 0 &&
                        std::abs(set.direction(static_cast<Eigen::Index>(i), axis)) > 0.99996);
    turns = turns && found;
  }
  for (int axis = 0; turns && axis < 3; ++axis)
    coordinates.push_back(y(point.body, point.set, axis, true));
  return std::make_unique<NodePort>(set.position.row(0).transpose(), coordinates);
}

Eigen::VectorXd frame_force(const System& system, int body, int direction) {
  return -system.bodies()[static_cast<size_t>(body)].rigid.col(direction);
}

}  // namespace clatter::dynamics
