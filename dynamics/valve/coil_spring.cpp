// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/valve/coil_spring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clatter::dynamics {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

std::vector<int> joined(const Port& a, const std::vector<int>& masses, const Port& b) {
  std::vector<int> all = a.coordinates();
  all.insert(all.end(), masses.begin(), masses.end());
  all.insert(all.end(), b.coordinates().begin(), b.coordinates().end());
  return all;
}

}  // namespace

ModalBody make_coil_body(const std::string& name, const CoilSpringSpec& spec, const Vector3d& axis,
                         const CoilStart& start) {
  const Eigen::Index n = spec.masses;
  const double root = std::sqrt(spec.mass / static_cast<double>(n));
  ModalBody body;
  body.name = name;
  body.shapes = MatrixXd::Identity(n, n) / root;
  body.omega_squared = body.damping = VectorXd::Zero(n);
  body.inertia = VectorXd::Ones(n);
  body.rigid = MatrixXd::Zero(n, 6);
  for (Eigen::Index k = 0; k < n; ++k) body.rigid.row(k).head<3>() = root * axis.transpose();
  body.is_rotation.assign(n, 0);
  body.rigid_modes = static_cast<int>(n);
  body.mass = spec.mass;
  body.eta_start.resize(n);
  body.v_start.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double at = (static_cast<double>(k) + 0.5) / static_cast<double>(n);
    body.eta_start(k) = root * (start.a + at * (start.b - start.a));
    body.v_start(k) = root * (start.a_rate + at * (start.b_rate - start.a_rate));
  }
  return body;
}

void CoilEnd::move(double time, const VectorXd& y, const VectorXd& v, Eigen::Index first) {
  y_ = y.segment(first, size());
  v_ = v.segment(first, size());
  port_->motion(time, y_, v_, at_);
  work_.noalias() = at_.work.topRows<3>().transpose() * axis_;
}

void CoilEnd::differentiate(double per_kappa) {
  by_travel_.noalias() = axis_.transpose() * at_.by_y.topRows<3>();
  by_rate_.noalias() = axis_.transpose() * at_.rate_by_y.topRows<3>();
  by_rate_.noalias() += per_kappa * (axis_.transpose() * at_.rate_by_v.topRows<3>());
}

void CoilEnd::add_curvature(double force, Eigen::Ref<MatrixXd> tangent) const {
  port_->add_curvature(y_, wrench(force * axis_, Vector3d::Zero()), tangent);
}

double CoilEnd::driven_power(double force) const {
  return -force * axis_.dot(at_.driven.head<3>());
}

CoilSpring::CoilSpring(std::string name, CoilEnd a, CoilEnd b, const std::vector<int>& masses,
                       const CoilSpringSpec& spec)
    : ForceElement(joined(a.port(), masses, b.port())),
      name_(std::move(name)),
      a_(std::move(a)),
      b_(std::move(b)),
      laws_(coil_laws(spec)),
      first_(a_.size()) {
  std::string prefix = name_;
  std::replace(prefix.begin(), prefix.end(), ' ', '_');
  recorded_ = {prefix + "_force", prefix + "_seat_force", prefix + "_least_gap"};
  const int n = spec.masses, n_a = a_.size(), n_b = b_.size();
  for (int i = 0; i <= n; ++i) {
    std::vector<int>& group = groups_.emplace_back();
    if (i == 0)
      for (int k = 0; k < n_a; ++k) group.push_back(k);
    if (i > 0) group.push_back(n_a + i - 1);
    if (i < n) group.push_back(n_a + i);
    if (i == n)
      for (int k = 0; k < n_b; ++k) group.push_back(n_a + n + k);
  }
}

CoilSpring::Part CoilSpring::part(size_t i, const VectorXd& y, const VectorXd& v) const {
  const auto mass = [&](size_t k) { return first_ + static_cast<Eigen::Index>(k); };
  const size_t n = laws_.size() - 1;
  const double left = i == 0 ? a_.travel() : y(mass(i - 1)),
               left_rate = i == 0 ? a_.rate() : v(mass(i - 1)),
               right = i == n ? b_.travel() : y(mass(i)),
               right_rate = i == n ? b_.rate() : v(mass(i));
  return {right - left, right_rate - left_rate};
}

void CoilSpring::fill_inner(double slope, MatrixXd& block) const {
  block.resize(2, 2);
  block << slope, -slope, -slope, slope;
}

/// Coordinates of the port and of the mass beside it, in the order of the group.
void CoilSpring::fill_end(CoilEnd& end, bool is_first, const CoilForce& law, double kappa,
                          MatrixXd& block) const {
  const Eigen::Index n = end.size(), mass = is_first ? n : 0, port = is_first ? 0 : 1;
  const double slope = law.by_length + law.by_rate / kappa, sign = is_first ? -1.0 : 1.0;
  block.resize(n + 1, n + 1);
  block(mass, mass) = slope;
  if (n == 0) return;
  end.differentiate(1.0 / kappa);
  // The part grows with the travel of end b and shrinks with that of end a; so do the forces.
  auto by_port = block.row(mass).segment(port, n);
  by_port = -law.by_length * end.by_travel() - law.by_rate * end.by_rate();
  block.col(mass).segment(port, n) = -slope * end.work();
  block.block(port, port, n, n).noalias() = -end.work() * by_port;
  end.add_curvature(sign * law.force, block.block(port, port, n, n));
}

void CoilSpring::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                          bool with_tangent, Response& response) {
  time_ = stage.time;
  const size_t n = laws_.size() - 1;
  const Eigen::Index after = first_ + static_cast<Eigen::Index>(n);
  a_.move(time_, y, v, 0);
  b_.move(time_, y, v, after);
  response.force.setZero(y.size());
  response.blocks.resize(laws_.size());
  last_.least_gap = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i <= n; ++i) {
    const Part at = part(i, y, v);
    const CoilForce law = laws_[i].at(at.change, at.rate);
    const Eigen::Index left = first_ + static_cast<Eigen::Index>(i) - 1;
    if (i == 0) {
      response.force.head(a_.size()) = -law.force * a_.work();
      last_.seat_force = law.force;
    } else {
      response.force(left) -= law.force;
    }
    if (i == n) {
      response.force.tail(b_.size()) = law.force * b_.work();
      last_.force = law.force;
    } else {
      response.force(left + 1) += law.force;
    }
    last_.least_gap = std::min(last_.least_gap, laws_[i].gap() + at.change);
    if (!with_tangent) continue;
    TangentBlock& block = response.blocks[i];
    block.active = true;
    if (i == 0 || i == n)
      fill_end(i == 0 ? a_ : b_, i == 0, law, stage.kappa, block.values);
    else
      fill_inner(law.by_length + law.by_rate / stage.kappa, block.values);
  }
}

Power CoilSpring::power(const VectorXd& y, const VectorXd& v) const {
  const size_t n = laws_.size() - 1;
  a_.move(time_, y, v, 0);
  b_.move(time_, y, v, first_ + static_cast<Eigen::Index>(n));
  Power sum;
  for (size_t i = 0; i <= n; ++i) {
    const Part at = part(i, y, v);
    const CoilForce law = laws_[i].at(at.change, at.rate);
    sum.stored += law.stored;
    sum.lost += law.lost;
    if (i == 0) sum.input += a_.driven_power(-law.force);
    if (i == n) sum.input += b_.driven_power(law.force);
  }
  return sum;
}

void CoilSpring::record(History& history) const {
  history.put(recorded_[0], "N", accepted_.force);
  history.put(recorded_[1], "N", accepted_.seat_force);
  history.put(recorded_[2], "m", accepted_.least_gap);
}

}  // namespace clatter::dynamics
