// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/error_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dynamics/integrate/rounding_floor.hpp"

namespace clatter::dynamics {

namespace {

constexpr double kWanted = 0.01;

}  // namespace

ErrorEstimate::ErrorEstimate(const System& system) : system_(&system) {}

void ErrorEstimate::add(double dt, const Eigen::VectorXd& e_eta, const Eigen::VectorXd& e_v,
                        const StageState& end) {
  const auto bodies = system_->bodies().size();
  if (sums_.size() == 0) {
    sums_ = Eigen::VectorXd::Zero(system_->modes());
    largest_.assign(bodies, 0.0);
    velocity_.assign(bodies, 0.0);
    noise_.assign(bodies, 0.0);
  }
  ++steps_;
  const auto &damping = system_->damping(), &inertia = system_->inertia(),
             &omega_squared = system_->omega_squared();
  for (Eigen::Index k = 0; k < sums_.size(); ++k) {
    const double local = std::sqrt(e_v(k) * e_v(k) + omega_squared(k) * e_eta(k) * e_eta(k));
    sums_(k) = sums_(k) * std::exp(-0.5 * dt * damping(k)) + inertia(k) * local;
  }
  for (size_t b = 0; b < bodies; ++b) {
    const int first = system_->mode_offset(static_cast<int>(b));
    const int count = system_->bodies()[b].modes();
    largest_[b] = std::max(largest_[b], sums_.segment(first, count).norm());
    const auto size = [&](const Eigen::VectorXd& x) {
      return x.segment(first, count).cwiseProduct(inertia.segment(first, count)).norm();
    };
    velocity_[b] = std::max(velocity_[b], size(end.v));
    noise_[b] = std::max(noise_[b], kRoundingNoise * size(end.eta) / dt);
  }
}

void ErrorEstimate::archive(Archive& archive) {
  archive(steps_);
  archive(sums_);
  for (std::vector<double>* values : {&largest_, &velocity_, &noise_}) archive(*values);
}

std::vector<BodyError> ErrorEstimate::bodies(const ErrorWeights& weights) const {
  std::vector<BodyError> found;
  for (size_t b = 0; b < velocity_.size(); ++b) {
    if (velocity_[b] <= 0.0 || system_->bodies()[b].mass <= 0.0) continue;
    const ModalBody& body = system_->bodies()[b];
    const std::string& name = body.family.empty() ? body.name : body.family;
    found.push_back({name, velocity_[b] / std::sqrt(body.mass), largest_[b] / velocity_[b],
                     weights.velocity_limit[b] / velocity_[b], body.velocity_scale,
                     velocity_[b] <= noise_[b]});
  }
  return found;
}

std::vector<std::string> accuracy_warnings(const std::vector<BodyError>& bodies,
                                           const Accuracy& accuracy, long long steps) {
  std::vector<std::string> lines;
  const auto inaccurate = [&](const BodyError& body) {
    return body.step_limit > kWanted && body.estimate > kWanted && !body.at_rest;
  };
  const auto worst = [&](const BodyError& body) {  // of its name, the first of equals
    for (const BodyError& other : bodies)
      if (other.name == body.name && inaccurate(other) &&
          (other.estimate > body.estimate || (other.estimate == body.estimate && &other < &body)))
        return false;
    return true;
  };
  for (const BodyError& body : bodies) {
    if (!inaccurate(body) || !worst(body)) continue;
    // Local errors fall with the third power of the step, so their sum falls with the second.
    const double more_steps = static_cast<double>(steps) * std::sqrt(body.estimate / kWanted);
    const bool own = body.velocity_scale > 0.0;
    const double scale = (own ? body.velocity_scale : accuracy.velocity_scale) * kWanted /
                         (body.step_limit * more_steps);
    lines.push_back(fmt::format(
        "{}: velocities are off by about {:.2g} % of the largest ({:.3g} m/s, rms over the body): "
        "{} is too coarse; set velocity_m_s = {:.1e} there for less than 1 %",
        body.name, 100.0 * body.estimate, body.speed,
        own ? "the body's own velocity_m_s" : "[accuracy]", scale));
  }
  return lines;
}

}  // namespace clatter::dynamics
