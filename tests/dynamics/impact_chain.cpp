// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/impact_chain.hpp"

#include <algorithm>
#include <memory>
#include <random>

#include "tests/dynamics/fixtures.hpp"

namespace clatter::dynamics::testing {

void LinkContact::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                           bool with_tangent, Response& response) {
  const double x = std::max(y(0) - y(1) - gap_, 0.0), rate = v(0) - v(1);
  const double force = k_ * x * (1.0 + c_ * rate);
  response.force.resize(2);
  response.force << -force, force;
  if (!with_tangent) return;
  const double slope = x > 0.0 ? k_ * (1.0 + c_ * rate + c_ * x / stage.kappa) : 0.0;
  response.tangent.resize(2, 2);
  response.tangent << -slope, slope, slope, -slope;
}

Power LinkContact::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  const double x = std::max(y(0) - y(1) - gap_, 0.0), rate = v(0) - v(1);
  return {0.5 * k_ * x * x, k_ * x * c_ * rate * rate, 0.0};
}

ImpactChain::ImpactChain(const ImpactChainOptions& options) {
  std::mt19937 engine(17);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const int n = options.links;
  Eigen::VectorXd speeds(n);
  for (int i = 0; i < n; ++i)
    speeds(i) = options.speed * (options.alternating ? (i % 2 == 0 ? 1.0 : -1.0) : number(engine));
  speeds.array() -= speeds.mean();
  for (int i = 0; i < n; ++i) {
    ModalBody body = point_mass(options.mass);
    body.v_start = speeds.segment(i, 1) / body.shapes(0, 0);
    links.push_back(system.coordinate(system.add_body(std::move(body)), 0));
  }
  for (int i = 0; i < n; ++i) {
    system.add_element(std::make_unique<LinkContact>(links[i], links[(i + 1) % n], options.gap,
                                                     options.stiffness, options.damping));
  }
}

}  // namespace clatter::dynamics::testing
