// SPDX-License-Identifier: GPL-3.0-or-later
// Impulses of contacts that touch together, against impacts that can be computed by hand.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "dynamics/law/impact_law.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Contacts of a rigid body at these arms with planes of normal z; axes z, x, y. m = 1.
struct Plate {
  Plate(double inertia, const std::vector<Vector3d>& arms)
      : G(3 * std::ssize(arms), 3 * std::ssize(arms)) {
    const std::array<Vector3d, 3> axis{Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitY()};
    for (size_t i = 0; i < arms.size(); ++i)
      for (size_t j = 0; j < arms.size(); ++j)
        for (size_t k = 0; k < 3; ++k)
          for (size_t l = 0; l < 3; ++l)
            G(static_cast<long>(3 * i + k), static_cast<long>(3 * j + l)) =
                axis[k].dot(axis[l]) + arms[i].cross(axis[k]).dot(arms[j].cross(axis[l])) / inertia;
  }
  MatrixXd G;
};

/// Velocities that all close by `speed` along the normal.
VectorXd closing(long contacts, double speed) {
  VectorXd u = VectorXd::Zero(3 * contacts);
  for (long i = 0; i < contacts; ++i) u(3 * i) = -speed;
  return u;
}

TEST(ImpactLaw, AloneAContactHasNewtonsRestitution) {
  const VectorXd impulse =
      impact_impulses(Plate(0.4, {{0.0, 0.0, 0.0}}).G, closing(1, 2.0), {{0.3}});
  EXPECT_NEAR(impulse(0), 1.3 * 2.0, 1e-15);
  EXPECT_EQ(impulse.tail<2>().norm(), 0.0);
}

TEST(ImpactLaw, ABallInSpinSticksOrSlides) {
  // 0.4 m r^2 about its centre, contact at r below it: a tangential impulse moves the point by
  // 3.5 / m.
  const MatrixXd G = Plate(0.4 * 0.01, {{0.0, 0.0, -0.1}}).G;
  const double v = 2.0, e = 0.5, mu = 0.2, limit = mu * (1.0 + e) * v;
  for (const double slip : {0.5 * 3.5 * limit, 4.0 * 3.5 * limit}) {
    const Vector3d impulse = impact_impulses(G, Vector3d(-v, 0.6 * slip, -0.8 * slip), {{e, mu}});
    const double along = std::min(slip / 3.5, limit);
    EXPECT_NEAR(impulse(0), (1.0 + e) * v, 1e-12);
    EXPECT_NEAR(impulse(1), -0.6 * along, 1e-12);
    EXPECT_NEAR(impulse(2), 0.8 * along, 1e-12);
  }
}

TEST(ImpactLaw, ARowOfBallsPassesTheImpulseOn) {
  // Five balls that touch, the first one strikes with v: the last one leaves with v.
  const long contacts = 4;
  MatrixXd G = MatrixXd::Zero(3 * contacts, 3 * contacts);
  for (long i = 0; i < contacts; ++i) {
    G(3 * i, 3 * i) = 2.0;
    if (i > 0) G(3 * i, 3 * i - 3) = G(3 * i - 3, 3 * i) = -1.0;
  }
  VectorXd u = VectorXd::Zero(3 * contacts);
  u(0) = -1.5;
  const VectorXd impulse = impact_impulses(G, u, std::vector<ImpactLaw>(contacts, {1.0}));
  for (long i = 0; i < contacts; ++i) EXPECT_NEAR(impulse(3 * i), 1.5, 1e-14) << i;
}

TEST(ImpactLaw, FourLegsShareTheImpulse) {
  // Three would do: the impulses are redundant.
  const Plate table(0.02, {{0.1, 0.1, 0.0}, {-0.1, 0.1, 0.0}, {-0.1, -0.1, 0.0}, {0.1, -0.1, 0.0}});
  for (const double e : {0.0, 0.4, 1.0})
    for (const double mu : {0.0, 0.3}) {
      const VectorXd u = closing(4, 1.0);
      const VectorXd impulse = impact_impulses(table.G, u, std::vector<ImpactLaw>(4, {e, mu}));
      for (long i = 0; i < 4; ++i) EXPECT_NEAR(impulse(3 * i), 0.25 * (1.0 + e), 1e-14);
      EXPECT_LT((u + table.G * impulse + e * u).norm(), 1e-14);
    }
}

TEST(ImpactLaw, APlasticRodWhoseFeetPushEachOtherEndsOnBoth) {
  // An impulse on one foot of a slender rod pushes the other one down.
  const Plate rod(0.004, {{0.1, 0.0, 0.0}, {-0.1, 0.0, 0.0}});
  ASSERT_LT(rod.G(0, 3), 0.0);
  VectorXd u = VectorXd::Zero(6);
  u(0) = -1.0;
  const VectorXd after = u + rod.G * impact_impulses(rod.G, u, {{0.0}, {0.0}});
  EXPECT_NEAR(after(0), 0.0, 1e-13);
  EXPECT_NEAR(after(3), 0.0, 1e-13);
}

TEST(ImpactLaw, AContactThatIsHeldIsNotInvolvedInWhatDoesNotTouchIt) {
  MatrixXd G = MatrixXd::Identity(6, 6);
  VectorXd u = closing(2, 1e-3);
  u(0) = -1.0;
  const VectorXd impulse = impact_impulses(G, u, {{0.5}, {0.5, 0.0, true}});
  EXPECT_NEAR(impulse(0), 1.5, 1e-15);
  EXPECT_EQ(impulse(3), 0.0);
}

TEST(HardTD4_EventsThatCoincide, NoImpactOfManyContactsGainsEnergyOrPulls) {
  // Random bodies, more contacts than degrees of freedom, unequal restitutions, friction.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0), part(0.0, 1.0);
  double gain = 0.0, closes = 0.0, pull = 0.0, beyond = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const long contacts = 1 + trial % 6, freedoms = 6;
    MatrixXd J(3 * contacts, freedoms);
    VectorXd v(freedoms);
    std::vector<ImpactLaw> laws;
    for (double& value : J.reshaped()) value = any(random);
    for (double& value : v) value = any(random);
    for (long i = 0; i < contacts; ++i)
      laws.push_back({part(random), trial % 2 == 0 ? 0.0 : 0.8 * part(random)});
    const MatrixXd G = J * J.transpose();
    const VectorXd u = J * v, impulse = impact_impulses(G, u, laws);
    const VectorXd v_after = v + J.transpose() * impulse, after = J * v_after;
    gain = std::max(gain, v_after.squaredNorm() - v.squaredNorm());
    for (long i = 0; i < contacts; ++i) {
      closes = std::max(closes, -after(3 * i));
      pull = std::max(pull, -impulse(3 * i));
      const double slip = impulse.segment<2>(3 * i + 1).norm();
      beyond = std::max(beyond, slip - laws[static_cast<size_t>(i)].friction * impulse(3 * i));
    }
  }
  test::expect_at_most("energy that impacts of many contacts gain, of 1 J", gain, 1e-12);
  test::expect_at_most("closing speed that is left, of 1 m/s", closes, 1e-12);
  test::expect_at_most("impulse that pulls, of 1 N s", pull, 0.0);
  test::expect_at_most("impulse of friction beyond its limit, of 1 N s", beyond, 1e-12);
}

}  // namespace
}  // namespace clatter::dynamics
