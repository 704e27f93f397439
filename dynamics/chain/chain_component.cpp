// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/chain/chain_component.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/body/rigid_body.hpp"
#include "dynamics/chain/chain_catalogue.hpp"
#include "dynamics/chain/plane_vector.hpp"

namespace clatter::dynamics {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

ChainComponent::ChainComponent(ChainSpec spec) : spec_(std::move(spec)), layout_(lay_out(spec_)) {
  for (const char* what : {"_tension_min", "_tension_max", "_jumps"})
    recorded_.push_back(spec_.name + what);
  for (const ChainOver& over : spec_.over)
    speeds_.push_back(fmt::format("{}_{}_speed", spec_.name, over.name));
  for (const BeltPart& part : layout_.belt.parts) {
    if (!part.straight || part.owner == part.next) continue;
    const auto name = [&](int owner) { return spec_.over[owner].name; };
    spans_.push_back(
        {fmt::format("{}_tension_{}_{}", spec_.name, name(part.owner), name(part.next)),
         0.5 * (part.from + part.to), (part.to - part.from).normalized()});
  }
}

/// Of the chain, as the first sprocket drives it [m/s].
double ChainComponent::start_speed(ModelBuilder& model) const {
  const ChainOver& first = spec_.over.front();
  const PortState state = model.at_start(*model.port(first.on));
  const double spin = state.spin(spec_.normal) * static_cast<double>(first.turn);
  return spin * first.belt.front().per_angle;
}

/// Between the instants of shapes [s].
double ChainComponent::shape_interval(double speed) const {
  if (!spec_.shape_every_deg) return spec_.shape_every.value_or(0.0);
  const double spin = std::abs(speed) / spec_.over.front().belt.front().per_angle;
  if (*spec_.shape_every_deg == 0.0) return 0.0;
  if (!(spin > 0.0))
    throw InputError(
        fmt::format("{}: shape_every_deg: {} does not turn at the start, expected "
                    "shape_every_us",
                    spec_.where, spec_.over.front().name));
  return *spec_.shape_every_deg * kDegree / spin;
}

void ChainComponent::add_bodies(ModelBuilder& model) {
  const double speed = speed_ = start_speed(model);
  if (!model.at_rest) shape_every_ = shape_interval(speed);
  const std::vector<LinkPlace> places = links_between(layout_.pins);
  const size_t n = places.size();
  for (size_t j = 0; j < n; ++j) {
    const Vector2d rear = speed * layout_.along[j], front = speed * layout_.along[(j + 1) % n];
    const Vector2d line = layout_.pins[(j + 1) % n] - layout_.pins[j];
    PlanarMotion start;
    start.centre = places[j].centre;
    start.angle = places[j].angle;
    start.velocity = 0.5 * (rear + front);
    start.spin = across(line).dot(front - rear) / line.squaredNorm();
    const LinkMass& mass = spec_.make.mass(static_cast<int>(j));
    ModalBody link = make_planar_body(fmt::format("{} link {}", spec_.name, j + 1), mass.mass,
                                      mass.inertia, start);
    const auto plane = spec_.plane();
    link.rigid.setZero();
    link.rigid.row(0).head<3>() = std::sqrt(mass.mass) * plane.first.transpose();
    link.rigid.row(1).head<3>() = std::sqrt(mass.mass) * plane.second.transpose();
    link.rigid(2, 3 + spec_.normal) = std::sqrt(mass.inertia);
    link.family = spec_.name;
    link.arm = spec_.make.half(static_cast<int>(j));
    const int body = model.add_body(std::move(link), spec_.where);
    if (j == 0) first_body_ = body;
  }
}

/// The profile of a sprocket is about the point of its port, with a gap where the layout has one;
/// that of a guide is given in the scene's axes.
ProfileCarrier ChainComponent::carrier(ModelBuilder& model, size_t index) const {
  const ChainOver& over = spec_.over[index];
  ProfileCarrier carrier;
  carrier.port = model.port(over.on);
  carrier.plane = spec_.plane();
  const PortState state = model.at_start(*carrier.port);
  const Vector2d axis = spec_.in_plane(state.rotation * carrier.plane.first);
  const double body = std::atan2(axis.y(), axis.x());
  if (over.teeth > 0) {
    carrier.angle = layout_.gaps[index] - body;
  } else {
    carrier.angle = -body;
    carrier.origin = spec_.in_plane(state.position);
  }
  return carrier;
}

ToothCount ChainComponent::tooth_count(size_t index) const {
  const ChainOver& over = spec_.over[index];
  if (over.teeth == 0) return {};
  const SeatedPin& pin = layout_.seated[index];
  return {spec_.make.links(), over.teeth, over.turn, pin.pin, pin.gap};
}

void ChainComponent::add_elements(ModelBuilder& model) {
  System& system = model.system;
  y_.clear();
  for (int j = 0; j < spec_.make.links(); ++j)
    for (int k = 0; k < 3; ++k) y_.push_back(system.coordinate(first_body_ + j, k));
  auto joints = std::make_unique<LinkJoints>(spec_.name + " joints", y_, spec_.make, spec_.joint);
  joints_ = joints.get();
  system.add_element(std::move(joints));
  contacts_.clear();
  for (size_t i = 0; i < spec_.over.size(); ++i) {
    const ChainOver& over = spec_.over[i];
    // Links differ by micrometres in their pitch: the outlines are those of the mean link.
    const double half = 0.5 * spec_.make.length() / spec_.make.links();
    LinkOutlines outlines;
    if (over.teeth > 0) {
      for (const double at : {-half, half})
        outlines.inner.push_back(LinkOutline::circle(at, spec_.bush_radius));
    } else {
      outlines.inner = outlines.outer = {LinkOutline::plate(-half, half, spec_.half_height)};
    }
    auto contact = std::make_unique<ProfileContact>(fmt::format("{} {}", spec_.name, over.name), y_,
                                                    spec_.make, over.profile, outlines, over.law,
                                                    carrier(model, i), tooth_count(i));
    contacts_.push_back(contact.get());
    system.add_element(std::move(contact));
  }
}

void ChainComponent::add_body_effects(const ModelBuilder&, EffectTable& effects) const {
  Effect& row = effects.add(
      find_effect(kChainEffects, "chain"), "chain " + spec_.name, true,
      fmt::format("[[chain]]: {} links in the plane, 3 coordinates each", spec_.make.links()),
      spec_.name + " joints");
  row.unknowns = traits().modes;
}

void ChainComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  for (const ChainOver& over : spec_.over)
    effects.add(find_effect(kChainEffects, "chain on a sprocket or guide"), "chain on " + over.name,
                true, over.teeth > 0 ? fmt::format("sprocket of {} teeth", over.teeth) : "guide",
                fmt::format("{} {}", spec_.name, over.name));
}

std::string ChainComponent::place_of(int body) const {
  const int link = body - first_body_;
  if (link < 0 || link >= spec_.make.links()) return "";
  return place_on_belt(spec_, layout_, link);
}

int ChainComponent::body_before(int body, double cycle) const {
  const int n = spec_.make.links(), link = body - first_body_;
  if (link < 0 || link >= n) return body;
  const auto moved = static_cast<int>(std::lround(speed_ * cycle * n / spec_.make.length()) % n);
  return first_body_ + (link + moved + n) % n;
}

/// Between the two joints beside the place of a span, linearly.
double ChainComponent::tension_at(const SpanPoint& span, const StageState& state) const {
  const std::vector<double>& tensions = joints_->tensions();
  const size_t n = tensions.size();
  double before = -std::numeric_limits<double>::infinity(), after = -before;
  size_t last = 0, next = 0;
  for (size_t j = 0; j < n; ++j) {
    const Vector2d centre(state.y(y_[3 * j]), state.y(y_[3 * j + 1]));
    const double angle = state.y(y_[3 * j + 2]);
    const Vector2d front =
        centre + spec_.make.half(static_cast<int>(j)) * Vector2d(std::cos(angle), std::sin(angle));
    const Vector2d from = front - span.middle;
    if (std::abs(across(span.along).dot(from)) > 4.0 * spec_.half_height) continue;
    const double at = span.along.dot(from);
    if (at <= 0.0 && at > before) {
      before = at;
      last = j;
    }
    if (at > 0.0 && at < after) {
      after = at;
      next = j;
    }
  }
  if (!std::isfinite(before) || !std::isfinite(after)) return 0.0;
  return (tensions[last] * after - tensions[next] * before) / (after - before);
}

void ChainComponent::record(const System& system, const StageState& state, History& history) const {
  const auto [least, most] =
      std::minmax_element(joints_->tensions().begin(), joints_->tensions().end());
  history.put(recorded_[0], "N", *least);
  history.put(recorded_[1], "N", *most);
  int jumps = 0;
  for (const ProfileContact* contact : contacts_) jumps += contact->teeth().jumped();
  history.put(recorded_[2], "1", jumps);
  for (const SpanPoint& span : spans_) history.put(span.recorded, "N", tension_at(span, state));
  for (size_t i = 0; i < contacts_.size(); ++i)
    if (spec_.over[i].teeth > 0)
      history.put(speeds_[i], "rad/s",
                  static_cast<double>(spec_.over[i].turn) *
                      contacts_[i]->spin(state.time, state.y, state.v_y));
  Component::record(system, state, history);
}

std::vector<std::string> ChainComponent::warnings() const {
  std::vector<std::string> warnings;
  for (size_t i = 0; i < contacts_.size(); ++i) {
    const ToothCount& teeth = contacts_[i]->teeth();
    if (teeth.jumped() == 0) continue;
    const int ahead = teeth.ahead();
    warnings.push_back(fmt::format(
        "chain \"{}\" jumped on sprocket \"{}\" at {:.6g} s, by {} teeth in all; at the end it is "
        "{} {} of where it was",
        spec_.name, spec_.over[i].name, teeth.first_time(), teeth.jumped(), std::abs(ahead),
        ahead < 0 ? "behind" : "ahead"));
  }
  return warnings;
}

ComponentList read_chains(const Config& root) {
  ComponentList chains;
  for (ChainSpec& spec : read_chain_specs(root))
    chains.push_back(std::make_shared<ChainComponent>(std::move(spec)));
  return chains;
}

}  // namespace clatter::dynamics
