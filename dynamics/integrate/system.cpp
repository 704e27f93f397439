// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/system.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/stopwatch.hpp"

namespace clatter::dynamics {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd gather(const VectorXd& all, const std::vector<int>& indices) {
  VectorXd picked(static_cast<Eigen::Index>(indices.size()));
  for (size_t i = 0; i < indices.size(); ++i)
    picked(static_cast<Eigen::Index>(i)) = all(indices[i]);
  return picked;
}

namespace {

VectorXd joined(const VectorXd& head, const VectorXd& tail) {
  VectorXd both(head.size() + tail.size());
  both << head, tail;
  return both;
}

}  // namespace

int System::add_body(ModalBody body) {
  offsets_.push_back(modes_);
  modes_ += body.modes();
  omega_squared_ = joined(omega_squared_, body.omega_squared);
  damping_ = joined(damping_, body.damping);
  inertia_ = joined(inertia_, body.inertia);
  rows_.emplace_back();
  places_.emplace_back();
  P_.emplace_back(0, body.modes());
  bodies_.push_back(std::move(body));
  return static_cast<int>(bodies_.size()) - 1;
}

int System::coordinate(int body, int dof) {
  return find_or_add(body, {dof, 0, Eigen::Vector3d::Zero()});
}

int System::frame_coordinate(int body, int k, const Eigen::Vector3d& point) {
  return find_or_add(body, {-1, k, k < 3 ? point : Eigen::Vector3d::Zero()});
}

int System::find_or_add(int body, const Place& place) {
  const auto b = static_cast<size_t>(body);
  const auto found = std::find(places_[b].begin(), places_[b].end(), place);
  if (found != places_[b].end()) return rows_[b][static_cast<size_t>(found - places_[b].begin())];
  const ModalBody& owner = bodies_[b];
  const Eigen::RowVectorXd row =
      place.dof >= 0 ? owner.row_of(place.dof)
                     : owner.force_of(unit_wrench(place.axis, place.point)).transpose();
  const int index = interface_size();
  owner_.push_back(body);
  rows_[b].push_back(index);
  places_[b].push_back(place);
  P_[b].conservativeResize(P_[b].rows() + 1, Eigen::NoChange);
  P_[b].bottomRows(1) = row;
  return index;
}

const System::Place& System::place_of(int y_index) const {
  const auto b = static_cast<size_t>(owner_[static_cast<size_t>(y_index)]);
  const auto at = std::find(rows_[b].begin(), rows_[b].end(), y_index) - rows_[b].begin();
  return places_[b][static_cast<size_t>(at)];
}

void System::add_element(std::unique_ptr<ForceElement> element) {
  costs_.push_back({element->name()});
  elements_.push_back(std::move(element));
}

void System::add_load(Load load) { loads_.push_back(std::move(load)); }

bool System::is_rotation(int y_index) const {
  const Place& place = place_of(y_index);
  if (place.dof < 0) return place.axis >= 3;
  const ModalBody& body = bodies_[static_cast<size_t>(owner_[static_cast<size_t>(y_index)])];
  return body.is_rotation[static_cast<size_t>(place.dof)] != 0;
}

std::string System::coordinate_name(int y_index) const {
  static constexpr const char* kAxes[] = {"x", "y", "z", "rx", "ry", "rz"};
  const Place& place = place_of(y_index);
  const ModalBody& body = bodies_[static_cast<size_t>(owner_[static_cast<size_t>(y_index)])];
  if (place.dof < 0) return fmt::format("{}: rigid frame, {}", body.name, kAxes[place.axis]);
  return fmt::format("{}: coordinate {}", body.name, place.dof);
}

VectorXd System::interface(const VectorXd& modal) const {
  VectorXd y(interface_size());
  for (size_t b = 0; b < bodies_.size(); ++b) {
    const VectorXd part = P_[b] * modal.segment(offsets_[b], bodies_[b].modes());
    for (size_t i = 0; i < rows_[b].size(); ++i)
      y(rows_[b][i]) = part(static_cast<Eigen::Index>(i));
  }
  return y;
}

void System::add_interface_force(const VectorXd& f_y, VectorXd& g) const {
  for (size_t b = 0; b < bodies_.size(); ++b) {
    if (rows_[b].empty()) continue;
    g.segment(offsets_[b], bodies_[b].modes()) += P_[b].transpose() * gather(f_y, rows_[b]);
  }
}

VectorXd System::load_force(double time) const {
  VectorXd g = VectorXd::Zero(modes_);
  for (const auto& load : loads_) {
    g.segment(mode_offset(load.body), load.direction.size()) += load.value(time) * load.direction;
  }
  return g;
}

void System::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v, bool with_tangent,
                      VectorXd& f, MatrixXd& tangent) {
  const int n = interface_size();
  f.setZero(n);
  if (with_tangent) tangent.setZero(n, n);
  for (size_t e = 0; e < elements_.size(); ++e) {
    const Stopwatch clock;
    const auto& at = elements_[e]->coordinates();
    elements_[e]->evaluate(stage, gather(y, at), gather(v, at), with_tangent, response_);
    for (size_t i = 0; i < at.size(); ++i) {
      f(at[i]) += response_.force(static_cast<Eigen::Index>(i));
    }
    for (size_t j = 0; with_tangent && j < at.size(); ++j) {
      for (size_t i = 0; i < at.size(); ++i) {
        tangent(at[i], at[j]) +=
            response_.tangent(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    }
    costs_[e].seconds += clock.seconds();
    ++costs_[e].evaluations;
  }
}

void System::begin_step(double time) {
  for (auto& element : elements_) element->begin_step(time);
}

void System::finish_stage(const Stage& stage) {
  for (auto& element : elements_) element->finish_stage(stage);
}

void System::accept_step(double time) {
  for (auto& element : elements_) element->accept_step(time);
}

}  // namespace clatter::dynamics
