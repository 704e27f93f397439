// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/chain/open_chain.hpp"

#include <gtest/gtest.h>

#include <string>

#include "dynamics/integrate/equilibrium.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics::testing {

using Eigen::Vector2d;
using Eigen::VectorXd;

OpenChain::OpenChain(const std::vector<Vector2d>& pins, double pitch, double stiffness) {
  make.closed = false;
  make.inner = make.outer = {2.4e-3, 4.4e-8};
  law.stiffness = stiffness;
  law.damping = 0.0;
  for (const LinkPlace& place : links_between(pins, false)) {
    make.kinds.push_back(make.kinds.size() % 2 == 0 ? LinkKind::kInner : LinkKind::kOuter);
    make.pitches.push_back(pitch);
    PlanarMotion start;
    start.centre = place.centre;
    start.angle = place.angle;
    for (const int k : add_planar(system, "link " + std::to_string(make.links()), make.inner.mass,
                                  make.inner.inertia, start))
      y.push_back(k);
  }
  joints = system.elements();
  system.add_element(std::make_unique<LinkJoints>("joints", y, make, law));
}

std::unique_ptr<Port> OpenChain::end(int link, double side) const {
  const auto at = y.begin() + 3 * link;
  return std::make_unique<PlanarPort>(std::vector<int>(at, at + 3),
                                      Vector2d(side * make.half(link), 0.0));
}

int OpenChain::pin(const std::string& name, std::unique_ptr<Port> a, std::unique_ptr<Port> b) {
  system.add_element(std::make_unique<PairElement>(name, std::move(a), std::move(b),
                                                   linear_joint(law.stiffness, 0.0)));
  return system.elements() - 1;
}

void OpenChain::pull(int body, const Vector2d& force) {
  Load load;
  load.term = "pull";
  load.body = body;
  const ModalBody& pulled = system.bodies()[body];
  load.direction = pulled.shapes.topRows<2>().transpose() * force;
  load.value = [](double) { return 1.0; };
  system.add_load(load);
}

VectorXd OpenChain::rest(double residual) {
  EquilibriumOptions options;
  options.residual = residual;
  const Equilibrium found = find_equilibrium(system, 0.0, system.eta_start(), options);
  EXPECT_TRUE(found.found) << found.residual << " after " << found.iterations;
  VectorXd at = system.interface(found.eta), force;
  const Stage stage{0.0, 1e9, 1, {}};
  system.evaluate(stage, at, VectorXd::Zero(at.size()), true, force);
  system.finish_stage(stage);
  system.accept_step(0.0);
  return at;
}

double OpenChain::tension(int joint) const {
  return dynamic_cast<const LinkJoints&>(system.element(joints)).tensions()[joint];
}

}  // namespace clatter::dynamics::testing
