// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/model_builder.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/base/error.hpp"
#include "dynamics/body/spatial_port.hpp"
#include "dynamics/integrate/spatial_body.hpp"

namespace clatter::dynamics {

ModelBuilder::ModelBuilder(const LoadedBodies& bodies, const TimeSpec& span,
                           const std::optional<CrankClock>& crank)
    : loaded(bodies), time(span), clock(crank) {
  for (const LoadedBody& one : loaded)
    index_[one.spec.name] = system.add_body(one.shapes ? add_floating(one) : one.modal);
}

ModalBody ModelBuilder::add_floating(const LoadedBody& body) {
  const BodySpec& spec = body.spec;
  const Eigen::Vector3d& centre = body.shapes->centre;
  const Eigen::Matrix3d A = spec.start.rotation.toRotationMatrix();
  ElasticStart start;
  start.frame = spec.start;
  start.frame.centre = (spec.is_placed ? spec.start.centre : centre) - A * centre;
  start.frame.velocity -= A * spec.start.spin.cross(centre);
  const FloatingBody made = make_floating_body(spec.name, *body.shapes, start);
  ModalBody modal = made.body;
  modal.displacement_scale = spec.displacement_scale;
  modal.velocity_scale = spec.velocity_scale;
  floating_.emplace(spec.name, Floating{made, start.frame});
  return modal;
}

const Shaft* ModelBuilder::shaft_of(const BodySpec& body) const {
  if (body.motion != BodyMotion::kDrive) return nullptr;
  const auto found = shafts_.find(body.drive);
  if (found == shafts_.end())
    throw InputError(fmt::format("{}: drive: no [[drive]] \"{}\" in the scene, found: {}",
                                 body.where, body.drive, names_of(shafts_)));
  return &found->second;
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

const TurningBody* ModelBuilder::find_turn(const std::string& name) const {
  const auto found = turns_.find(name);
  return found == turns_.end() ? nullptr : &found->second;
}

const TurningBody& ModelBuilder::turn(const std::string& name, const std::string& where) const {
  if (const TurningBody* found = find_turn(name)) return *found;
  throw InputError(fmt::format("{}: no body \"{}\" that turns about an axis, found: {}", where,
                               name, names_of(turns_)));
}

int ModelBuilder::y(const std::string& body, const std::string& set, int axis, bool rotation) {
  return system.coordinate(index_.at(body),
                           set_dof(find_body(loaded, body)->model, set, axis, rotation));
}

PortState ModelBuilder::at_start(Port& port) const {
  system.start_frames(time.begin);
  PortState state;
  port.motion(time.begin, gather(system.interface(system.eta_start()), port.coordinates()),
              gather(system.interface(system.v_start()), port.coordinates()), state);
  return state;
}

Eigen::Vector3d ModelBuilder::position(const PointSpec& point,
                                       const std::optional<Eigen::Vector3d>& fallback) const {
  if (point.at) return *point.at;
  if (!point.set.empty()) {
    const LoadedBody* body = find_body(loaded, point.body);
    if (body == nullptr)
      throw InputError(fmt::format("{}.set: no body \"{}\" with a reduced model in the scene",
                                   point.where, point.body));
    const Eigen::Vector3d at = body->model.set(point.set).position.row(0);
    const auto floating = floating_.find(point.body);
    if (floating == floating_.end()) return at;
    const SpatialMotion& start = floating->second.start;
    return start.centre + start.rotation * at;
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
  const Node node = node_of(body.model, point.set);
  if (body.shapes) return floating_port(body, node);
  std::vector<int> coordinates;
  for (const int dof : node.dofs)
    coordinates.push_back(system.coordinate(index_.at(point.body), dof));
  const Shaft* shaft = shaft_of(body.spec);
  if (shaft == nullptr) return std::make_unique<NodePort>(node.position, coordinates);
  return std::make_unique<TurningNodePort>(shaft->drive, shaft->centre, shaft->axis,
                                           shaft->drive.at(time.begin).position, node.position,
                                           coordinates);
}

std::unique_ptr<Port> ModelBuilder::floating_port(const LoadedBody& body, const Node& node) {
  const FloatingBody& floating = floating_.at(body.spec.name).body;
  const Eigen::Index n = floating.W.rows();
  const auto rows = [&](size_t first) {
    Matrix3X N(3, n);
    for (size_t k = 0; k < 3; ++k)
      N.row(static_cast<Eigen::Index>(k)) = body.modal.row_of(node.dofs[first + k]).tail(n);
    return N;
  };
  const int index = index_.at(body.spec.name);
  Matrix3X slope;
  if (node.dofs.size() == 6) slope = rows(3) * floating.W;
  return std::make_unique<SpatialPort>(coordinates_in_space(system, index),
                                       system.bodies()[index].frame, floating.arm(node.position),
                                       floating.shape(rows(0)), slope);
}

Eigen::VectorXd frame_force(const System& system, int body, int direction) {
  return -system.bodies()[body].rigid.col(direction);
}

}  // namespace clatter::dynamics
