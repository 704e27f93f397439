// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/rod_truss.hpp"

namespace clatter::dynamics::testing {

using Eigen::Vector3d;

Truss rod_truss(double stiffness, double skew) {
  Truss rod;
  rod.stiffness = stiffness;
  rod.node = {Vector3d::Zero(), Vector3d(0.0, 0.0, kRodLength)};
  rod.mass = {0.9, 0.45};
  const double heights[] = {0.2, 0.5, 0.8}, masses[] = {0.3, 0.25, 0.3};
  for (int frame = 0; frame < 3; ++frame)
    for (const double x : {-0.012, 0.012})
      for (const double y : {-0.02, 0.02}) {
        rod.node.emplace_back(x, y, heights[frame] * kRodLength);
        rod.mass.push_back(0.25 * masses[frame] *
                           (1.0 + skew * ((x > 0.0 ? 0.4 : -0.3) + (y > 0.0 ? 0.2 : -0.4))));
      }
  const auto join = [&](int from, int to) { rod.spring.push_back({from, to}); };
  const auto frame_of = [](int node) { return (node - 2) / 4; };
  for (int a = 2; a < 14; ++a) {
    if (frame_of(a) == 0) join(0, a);
    if (frame_of(a) == 2) join(1, a);
    for (int b = a + 1; b < 14; ++b)
      if (frame_of(b) - frame_of(a) <= 1) join(a, b);
  }
  return rod;
}

rom::ReducedModel rod_model(const Truss& truss) {
  rom::ReducedModel model = truss.model();
  model.name = "rod";
  model.method = "guyan";
  model.valid_to_hz = 5000.0;
  for (size_t i = 0; i < truss.node.size(); ++i)
    model.mass.centre += truss.mass[i] / model.mass.mass * truss.node[i];
  model.mass.inertia = 1e-3 * Eigen::Matrix3d::Identity();
  for (const int end : {0, 1}) {
    const std::string name = end == 0 ? "big_end" : "small_end";
    rom::DofSet& set = model.sets[name];
    set.kind = "bearing";
    for (int axis = 0; axis < 3; ++axis) {
      set.dofs.push_back(3 * end + axis);
      set.labels.push_back(name + "." + "xyz"[axis]);
      set.is_rotation.push_back(0);
    }
    set.position = truss.node[end].transpose().replicate(3, 1);
    set.direction = Eigen::Matrix3d::Identity();
  }
  return model;
}

}  // namespace clatter::dynamics::testing
