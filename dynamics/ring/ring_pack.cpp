// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ring/ring_pack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace clatter::dynamics {
namespace {

int liner_columns(const RingPackBodies& bodies) {
  if (!bodies.liner) return 0;
  const rom::ContactGrid& grid = bodies.liner->grid;
  return static_cast<int>(grid.angle.size() * grid.axial.size()) + film::kFits;
}

}  // namespace

RingPack::RingPack(RingPackOptions options, RingPackBodies bodies, std::vector<int> coordinates)
    : ForceElement(std::move(coordinates)),
      options_(std::move(options)),
      bodies_(std::move(bodies)),
      n_liner_(liner_columns(bodies_)),
      viscosity_(options_.oil, options_.viscosity),
      instants_(options_.rings.size()) {
  bodies_.crank.join(coordinates_);
  const auto n = static_cast<int>(coordinates_.size());
  const film::LinerAxial liner{pin() + 6, n_liner_ - film::kFits + 2};
  const film::AxialMotion motion = bodies_.liner
                                       ? film::axial_motion(n, pin(), bodies_.liner_axial, &liner)
                                       : film::axial_motion(n, pin(), bodies_.bore_axis, nullptr);
  axial_ = motion.slide.row(0) + bodies_.bore_axis.y() * motion.slide.row(1) -
           bodies_.bore_axis.x() * motion.slide.row(2);
  if (bodies_.liner)
    for (const RingSpec& ring : options_.rings)
      lateral_.emplace_back(*bodies_.liner, ring.height, options_.bore_radius);
  touched_place_.assign(coordinates_.size(), -1);
  touched_.reserve(coordinates_.size());
  for (Totals* totals : {&last_, &finished_, &accepted_})
    totals->friction.assign(options_.rings.size(), 0.0);
}

// The patches beside rings that hold the piston, the fit, the pin, the axial coordinate, the crank.
void RingPack::list_touched(Response& response) {
  std::fill(touched_place_.begin(), touched_place_.end(), -1);
  for (size_t k = 0; k < lateral_.size(); ++k) {
    if (options_.rings[k].groove == 0.0) continue;
    for (const int column : lateral_[k].columns()) touched_place_[column] = 0;
  }
  for (size_t i = static_cast<size_t>(std::max(n_liner_ - film::kFits, 0));
       i < touched_place_.size(); ++i)
    touched_place_[i] = 0;
  touched_.clear();
  for (size_t i = 0; i < touched_place_.size(); ++i) {
    if (touched_place_[i] < 0) continue;
    touched_place_[i] = static_cast<int>(touched_.size());
    touched_.push_back(static_cast<int>(i));
  }
  response.touched.clear();
  if (touched_.size() < touched_place_.size()) response.touched = touched_;
}

// N along the stroke: the groove accelerates the ring against the gas and the friction T.
double RingPack::groove_load(size_t ring, double pressure, double acceleration,
                             double friction) const {
  const RingSpec& one = options_.rings[ring];
  const double below = ring + 1 < options_.rings.size() ? options_.rings[ring + 1].gas_share : 0.0;
  const double area =
      2.0 * std::numbers::pi * (options_.bore_radius - 0.5 * one.thickness) * one.thickness;
  return one.mass * acceleration + (one.gas_share - below) * pressure * area - friction;
}

// The piston's lateral motion in the groove against the bore, by the touched coordinates.
void RingPack::find_rows(size_t ring, double stroke) {
  const double h = options_.rings[ring].height;
  const Eigen::Vector2d& axis = bodies_.bore_axis;
  slide_.setZero(2, std::ssize(touched_));
  slide_rate_.setZero(2, std::ssize(touched_));
  const auto place = [&](int coordinate) { return touched_place_[coordinate]; };
  slide_(0, place(pin())) = 1.0;
  slide_(1, place(pin() + 1)) = 1.0;
  slide_(1, place(pin() + 3)) = -h;
  slide_(0, place(pin() + 4)) = h;
  slide_(0, place(pin() + 5)) = -axis.y();
  slide_(1, place(pin() + 5)) = axis.x();
  if (lateral_.empty()) return;
  RingLateral& bore = lateral_[ring];
  bore.move(stroke);
  for (size_t k = 0; k < bore.columns().size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    slide_.col(place(bore.columns()[k])) -= bore.rows().col(column);
    slide_rate_.col(place(bore.columns()[k])) -= bore.slope().col(column);
  }
}

void RingPack::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                        bool with_tangent, Response& response) {
  const CrankLead lead = bodies_.crank.lead(stage, y, v);
  const double time = stage.time + lead.now.position;
  const Motion<double> given = bodies_.stroke(time);
  const Stroke stroke{led(given, lead.now), bodies_.stroke(stage.time).velocity,
                      bodies_.gas ? std::max(bodies_.gas(time), 0.0) : 0.0,
                      led_by_turn(given, lead).acceleration};
  for (size_t k = 0; k < lateral_.size(); ++k)
    if (options_.rings[k].groove > 0.0) lateral_[k].move(stroke.motion.position);
  list_touched(response);
  const auto n = static_cast<Eigen::Index>(touched_.size());
  axial_touched_.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) axial_touched_(i) = axial_(touched_[i]);
  response.force.setZero(y.size());
  if (with_tangent) response.tangent.setZero(n, n);
  last_.groove = last_.axial_lost = last_.lateral_lost = last_.input = 0.0;
  for (size_t k = 0; k < options_.rings.size(); ++k) {
    add_ring(k, stroke, y, v);
    const Instant& at = instants_[k];
    response.force += at.friction * axial_.transpose();
    if (options_.rings[k].groove > 0.0)
      for (Eigen::Index i = 0; i < n; ++i)
        response.force(touched_[i]) += slide_.col(i).dot(at.force);
    if (with_tangent) add_tangent(at, stage.kappa, stroke.motion.velocity, response);
  }
}

void RingPack::add_ring(size_t ring, const Stroke& at_crank, const Eigen::VectorXd& y,
                        const Eigen::VectorXd& v) {
  const RingSpec& one = options_.rings[ring];
  const auto& [stroke, clock_rate, pressure, acceleration_by_turn] = at_crank;
  Instant& at = instants_[ring];
  at = {0.0,
        0.0,
        0.0,
        0.0,
        Eigen::Vector2d::Zero(),
        Eigen::Vector2d::Zero(),
        one.mass * acceleration_by_turn};
  const double speed = axial_.dot(v) + clock_rate;
  if (one.boundary > 0.0) {
    const double load = one.load + one.gas_share * pressure * one.width;
    const RingShear shear = ring_shear(one, viscosity_.at_height(stroke.position + one.height),
                                       load, speed, options_.reversal_speed);
    const double length = 2.0 * std::numbers::pi * options_.bore_radius;
    at.friction = length * shear.force;
    at.friction_slope = length * shear.slope;
  }
  last_.friction[ring] = at.friction;
  last_.axial_lost -= at.friction * speed;
  last_.input -= at.friction * clock_rate;
  if (one.groove == 0.0) return;
  find_rows(ring, stroke.position);
  Eigen::Vector2d prescribed = Eigen::Vector2d::Zero();
  for (size_t i = 0; i < touched_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    at.slip += slide_.col(column) * v(touched_[i]);
    prescribed += slide_rate_.col(column) * (stroke.velocity * y(touched_[i]));
  }
  at.slip += prescribed;
  const double load = groove_load(ring, pressure, stroke.acceleration, at.friction);
  at.groove_load = one.groove * std::abs(load);
  at.groove_sign = std::copysign(one.groove, load);
  at.force = -at.groove_load / std::hypot(at.slip.norm(), options_.groove_speed) * at.slip;
  last_.groove += at.force.y();
  last_.lateral_lost -= at.force.dot(at.slip);
  last_.input -= at.force.dot(prescribed);
}

void RingPack::add_tangent(const Instant& at, double kappa, double stroke_rate,
                           Response& response) {
  const double along = at.friction_slope / kappa;  // dT/dU over kappa
  response.tangent.noalias() += (along * axial_touched_.transpose()) * axial_touched_;
  if (at.groove_load == 0.0) return;
  const double r = std::hypot(at.slip.norm(), options_.groove_speed);
  const Eigen::Matrix2d by_slip =
      -at.groove_load / r * (Eigen::Matrix2d::Identity() - at.slip * at.slip.transpose() / (r * r));
  // ds/dy at fixed stage; N falls by T.
  slide_by_y_ = slide_ / kappa + stroke_rate * slide_rate_;
  force_by_y_.noalias() = by_slip * slide_by_y_;
  force_by_y_.noalias() += (at.groove_sign * along / r * at.slip) * axial_touched_;
  if (bodies_.crank.is_free())
    force_by_y_.rightCols<1>() -= at.groove_sign * at.load_by_turn / r * at.slip;
  response.tangent.noalias() += slide_.transpose() * force_by_y_;
}

Power RingPack::power(const Eigen::VectorXd&, const Eigen::VectorXd&) const {
  return {0.0, last_.axial_lost + last_.lateral_lost, last_.input};
}

void RingPack::record(History& history) const {
  const std::vector<double>& friction = accepted_.friction;
  history.put("ring_friction_force", "N", std::accumulate(friction.begin(), friction.end(), 0.0));
  history.put("ring_friction_power", "W", accepted_.axial_lost);
  history.put("ring_groove_force", "N", accepted_.groove);
  history.put("ring_groove_power", "W", accepted_.lateral_lost);
  for (size_t k = 0; k < friction.size(); ++k)
    history.put(fmt::format("ring_{}_friction", k + 1), "N", friction[k]);
}

}  // namespace clatter::dynamics
