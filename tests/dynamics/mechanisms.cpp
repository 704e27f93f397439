// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/mechanisms.hpp"

#include <cmath>
#include <random>

namespace clatter::dynamics::testing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kXa = -0.06934, kYa = -0.00227, kXb = -0.03635, kYb = 0.03273, kXc = 0.014,
                 kYc = 0.072;
constexpr double kD = 28e-3, kDa = 115e-4, kE = 2e-2, kEa = 1421e-5, kRr = 7e-3, kRa = 92e-5,
                 kL0 = 7785e-5, kSs = 35e-3, kSa = 1874e-5, kSb = 1043e-5, kSc = 18e-3, kSd = 2e-2,
                 kTa = 2308e-5, kTb = 916e-5, kU = 4e-2, kUa = 1228e-5, kUb = 449e-5, kZf = 2e-2,
                 kZt = 4e-2, kFa = 1421e-5, kMoment = 33e-3, kSpring = 4530.0;
constexpr double kMass[7] = {0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498};
constexpr double kInertia[7] = {2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7,
                                1.169e-5, 5.667e-7, 1.912e-5};
constexpr double kBeta = -0.0617138900142764496358948458001, kTheta = 0.0,
                 kGamma = 0.455279819163070380255912382449, kPhi = 0.222668390165885884674473185609,
                 kDelta = 0.487364979543842550225598953530,
                 kOmega = -0.222668390165885884674473185609,
                 kEpsilon = 1.23054744454982119249735015568;

Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

Eigen::VectorXd arbitrary(int n, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Eigen::VectorXd values(n);
  for (double& value : values) value = number(engine);
  return values;
}

double tangent_error(ForceElement& element, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                     double step, double kappa) {
  const Stage stage{0.1, kappa, 1, {kappa}};
  Response at, low, high;
  element.evaluate(stage, y, v, true, at);
  Eigen::MatrixXd tangent = at.tangent;
  if (!element.groups().empty()) {
    tangent.setZero(y.size(), y.size());
    for (size_t g = 0; g < at.blocks.size(); ++g)
      if (at.blocks[g].active)
        tangent(element.groups()[g], element.groups()[g]) += at.blocks[g].values;
  }
  Eigen::MatrixXd differences(tangent.rows(), tangent.cols());
  for (int j = 0; j < y.size(); ++j) {
    Eigen::VectorXd dy = Eigen::VectorXd::Zero(y.size());
    dy(j) = step;
    element.evaluate(stage, y + dy, v + dy / kappa, false, high);
    element.evaluate(stage, y - dy, v - dy / kappa, false, low);
    differences.col(j) = (high.force - low.force) / (2.0 * step);
  }
  return (tangent - differences).cwiseAbs().maxCoeff() / tangent.cwiseAbs().maxCoeff();
}

Andrews::Andrews(double stiffness, double damping) {
  // Rotations of the bodies, and unit vectors along (c) and across (s) each.
  const double turn[7] = {kBeta,  kBeta + kTheta,    kGamma,  kPhi + kDelta,
                          kDelta, kOmega + kEpsilon, kEpsilon};
  Vector2d c[7], s[7];
  for (int k = 0; k < 7; ++k) {
    c[k] = direction(turn[k]);
    s[k] = {-c[k].y(), c[k].x()};
  }
  const Vector2d a(kXa, kYa), b(kXb, kYb), spring_end(kXc, kYc);
  // Centres of mass.
  const Vector2d centre[7] = {kRa * c[0],
                              kRr * c[0] - kDa * c[1],
                              b - kSa * s[2] + kSb * c[2],
                              a + kZt * c[4] - (kE - kEa) * s[3],
                              a + kTa * c[4] + kTb * s[4],
                              a - kU * s[6] + (kZf - kFa) * c[5],
                              a - kUa * s[6] - kUb * c[6]};
  for (int k = 0; k < 7; ++k) {
    PlanarMotion start;
    start.centre = centre[k];
    start.angle = turn[k];
    bodies.push_back(add_planar(system, "K" + std::to_string(k + 1), kMass[k], kInertia[k], start));
  }
  // A point of a body, given where it is at the start.
  const auto point = [&](int k, const Vector2d& at) -> std::unique_ptr<Port> {
    const Vector2d from = at - centre[k];
    return std::make_unique<PlanarPort>(bodies[k], Vector2d(from.dot(c[k]), from.dot(s[k])));
  };
  const auto ground = [](const Vector2d& at) -> std::unique_ptr<Port> {
    return std::make_unique<GroundPort>(Vector3d(at.x(), at.y(), 0.0));
  };
  const auto join = [&](std::unique_ptr<Port> one, std::unique_ptr<Port> other) {
    system.add_element(std::make_unique<PairElement>("joint", std::move(one), std::move(other),
                                                     linear_joint(stiffness, damping)));
  };
  const Vector2d crank = kRr * c[0], fork = crank - kD * c[1];
  join(point(0, {0.0, 0.0}), ground({0.0, 0.0}));
  join(point(0, crank), point(1, crank));
  join(point(1, fork), point(2, fork));
  join(point(1, fork), point(3, fork));
  join(point(1, fork), point(5, fork));
  join(point(2, b), ground(b));
  join(point(4, a), ground(a));
  join(point(6, a), ground(a));
  join(point(3, a + kZt * c[4]), point(4, a + kZt * c[4]));
  join(point(5, a - kU * s[6]), point(6, a - kU * s[6]));
  system.add_element(std::make_unique<PairElement>(
      "spring", point(2, b + kSd * c[2] - kSc * s[2]), ground(spring_end),
      std::make_unique<LineSpring>(kSpring, 0.0, kL0)));
  system.add_element(std::make_unique<Moment>(bodies[0][2], kMoment));
}

Eigen::Matrix<double, 7, 1> Andrews::angles(const Eigen::VectorXd& y) const {
  const auto turn = [&](size_t k) { return y(bodies[k][2]); };
  Eigen::Matrix<double, 7, 1> found;
  found << turn(0), turn(1) - turn(0), turn(2), turn(3) - turn(4), turn(4), turn(5) - turn(6),
      turn(6);
  return found;
}

}  // namespace clatter::dynamics::testing
