// SPDX-License-Identifier: GPL-3.0-or-later
// The Newton matrix, dense and sparse.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numeric>
#include <random>

#include "dynamics/integrate/stage_matrix.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Planar links joined by bushings, the first one to the ground; the last one too when closed.
std::unique_ptr<System> chain(int links, bool closed) {
  auto system = std::make_unique<System>();
  std::vector<std::vector<int>> at;
  for (int k = 0; k < links; ++k) {
    PlanarMotion start;
    start.centre.x() = k;
    start.angle = 0.1 * k;
    at.push_back(testing::add_planar(*system, "link", 2.0, 0.5, start));
  }
  const auto join = [&](std::unique_ptr<Port> a, std::unique_ptr<Port> b) {
    system->add_element(std::make_unique<PairElement>("joint", std::move(a), std::move(b),
                                                      linear_joint(1e4, 10.0)));
  };
  const auto end = [&](int k, double arm) -> std::unique_ptr<Port> {
    return std::make_unique<PlanarPort>(at[k], Eigen::Vector2d(arm, 0.0));
  };
  const auto ground = [](double x) -> std::unique_ptr<Port> {
    return std::make_unique<GroundPort>(Eigen::Vector3d(x, 0.0, 0.0));
  };
  join(end(0, -0.5), ground(-0.5));
  for (int k = 1; k < links; ++k) join(end(k - 1, 0.5), end(k, -0.5));
  if (closed) join(end(links - 1, 0.5), ground(links - 0.5));
  return system;
}

/// J = I - S T entry by entry, in the order of y.
MatrixXd dense_matrix(const System& system, const StageOperator& op) {
  const int n = system.interface_size();
  MatrixXd T = MatrixXd::Zero(n, n), S = MatrixXd::Zero(n, n);
  for (int e = 0; e < system.elements(); ++e) {
    const Response& response = system.response(e);
    const auto& groups = system.groups(e);
    for (size_t g = 0; g < groups.size(); ++g) {
      if (!system.has_groups(e))
        T(groups[g], groups[g]) += response.tangent;
      else if (response.blocks[g].active)
        T(groups[g], groups[g]) += response.blocks[g].values;
    }
  }
  for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b)
    S(system.rows(b), system.rows(b)) = op.S(b);
  return MatrixXd::Identity(n, n) - S * T;
}

MatrixXd coupled(int n) { return -MatrixXd::Identity(n, n) * 3.0 - MatrixXd::Ones(n, n); }

/// A body of n coupled coordinates, all of them requested from `system`.
std::vector<int> add_plate(System& system, int n) {
  ModalBody body;
  body.name = "plate";
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  body.shapes =
      MatrixXd::NullaryExpr(n, n, [&](Eigen::Index, Eigen::Index) { return number(engine); });
  body.omega_squared = VectorXd::LinSpaced(n, 1.0, 9.0);
  body.damping = VectorXd::Zero(n);
  body.inertia = VectorXd::Ones(n);
  body.is_rotation.assign(n, 0);
  body.mass = 1.0;
  const int b = system.add_body(body);
  std::vector<int> all;
  for (int k = 0; k < n; ++k) all.push_back(system.coordinate(b, k));
  return all;
}

/// Linear forces between coordinates that are coupled in groups; every third group has none, from
/// one second to the next others.
class GroupedSprings : public ForceElement {
 public:
  GroupedSprings(std::vector<int> coordinates, std::vector<std::vector<int>> groups)
      : ForceElement(std::move(coordinates)), groups_(std::move(groups)) {}
  std::string name() const override { return "grouped springs"; }
  const std::vector<std::vector<int>>& groups() const override { return groups_; }
  void evaluate(const Stage& stage, const VectorXd& y, const VectorXd&, bool,
                Response& response) override {
    response.force.setZero(y.size());
    response.blocks.resize(groups_.size());
    for (size_t g = 0; g < groups_.size(); ++g) {
      TangentBlock& block = response.blocks[g];
      block.active = (g + static_cast<size_t>(stage.time)) % 3 != 2;
      block.values = 1e3 * coupled(static_cast<int>(groups_[g].size()));
      block.values(0, 1) *= 1.5;  // no symmetry
      if (block.active) response.force(groups_[g]) += block.values * y(groups_[g]);
    }
  }
  Power power(const VectorXd&, const VectorXd&) const override { return {}; }

 private:
  std::vector<std::vector<int>> groups_;
};

/// A linear force on chosen coordinates of a body with many.
class FewSprings : public ForceElement {
 public:
  FewSprings(std::vector<int> coordinates, std::vector<int> touched, MatrixXd tangent)
      : ForceElement(std::move(coordinates)),
        touched_(std::move(touched)),
        tangent_(std::move(tangent)) {}
  std::string name() const override { return "springs"; }
  void evaluate(const Stage&, const VectorXd& y, const VectorXd&, bool,
                Response& response) override {
    response.touched = touched_;
    response.tangent = tangent_;
    response.force.setZero(y.size());
    response.force(touched_) = tangent_ * y(touched_);
  }
  Power power(const VectorXd&, const VectorXd&) const override { return {}; }

 private:
  std::vector<int> touched_;
  MatrixXd tangent_;
};

/// A chain whose links touch a part of `rows` coupled coordinates, three of them each.
std::unique_ptr<System> chain_on_plate(int links, int rows) {
  auto system = chain(links, true);
  const std::vector<int> plate = add_plate(*system, rows);
  std::vector<int> coordinates(static_cast<size_t>(3 * links));
  std::iota(coordinates.begin(), coordinates.end(), 0);
  coordinates.insert(coordinates.end(), plate.begin(), plate.end());
  std::vector<std::vector<int>> groups;
  for (int k = 0; k < links; ++k)
    groups.push_back(
        {3 * k, 3 * k + 1, 3 * k + 2, 3 * links + k % (rows - 2) + 1, 3 * links + k % (rows - 2)});
  system->add_element(std::make_unique<GroupedSprings>(std::move(coordinates), std::move(groups)));
  return system;
}

/// The matrix of a system at an arbitrary state, seen to solve as that of its definition does.
StageMatrix checked(System& system) {
  const double kappa = 1e-3;
  const int n = system.interface_size();
  VectorXd y = VectorXd::Zero(n), f;
  y.head(system.eta_start().size()) = system.interface(system.eta_start());
  const VectorXd v = VectorXd::Constant(n, 0.3);
  system.evaluate({0.0, kappa, 1, {}}, y, v, true, f);
  const StageOperator op(system, kappa);
  StageMatrix matrix(system);
  EXPECT_TRUE(matrix.form(op));
  const VectorXd right = VectorXd::LinSpaced(n, -1.0, 2.0);
  VectorXd x = right;
  matrix.solve(op, x);
  const MatrixXd J = dense_matrix(system, op);
  EXPECT_LT((J * x - right).norm(), 1e-12 * (right.norm() + J.norm() * x.norm()));
  VectorXd forces = VectorXd::Zero(n);
  system.add_tangent_forces(x, forces);
  VectorXd S_forces(n);
  op.apply_S(forces, S_forces);
  EXPECT_LT((x - S_forces - J * x).norm(), 1e-12 * (J.norm() * x.norm()));
  return matrix;
}

TEST(StageMatrix, GroupsOfAnElementAreBlocksOfTheTangent) {
  for (const int links : {3, 60}) {
    auto narrow = chain_on_plate(links, 5);
    EXPECT_EQ(checked(*narrow).is_sparse(), links == 60);
  }
}

TEST(StageMatrix, APartWithManyRowsStaysToTheEndAndItsLinksTouchFewOfThem) {
  // 60 links on a part of 30 coupled rows, of which each touches two: 30 full columns for each of
  // 180 coordinates would be 5400 entries, S itself has 900.
  auto system = chain_on_plate(60, 30);
  const StageMatrix matrix = checked(*system);
  ASSERT_TRUE(matrix.is_sparse());
  EXPECT_FALSE(matrix.sparse()->is_dense());
  EXPECT_LT(matrix.nonzeros(), 4200);
}

TEST(StageMatrix, FewLinksBesidePartsWithManyRowsAreDense) {
  // 150 of 210 unknowns are of parts of which three rows are touched at the moment.
  auto system = chain(20, true);
  for (int part = 0; part < 5; ++part) {
    const std::vector<int> all = add_plate(*system, 30);
    system->add_element(std::make_unique<FewSprings>(all, std::vector{2, 7, 11}, coupled(3)));
  }
  EXPECT_FALSE(StageMatrix(*system).is_sparse());
}

TEST(StageMatrix, CouplingsMayComeAndGo) {
  // The springs between links and plate that act are others in each turn.
  auto system = chain_on_plate(60, 30);
  const double kappa = 1e-3;
  const int n = system->interface_size();
  const StageOperator op(*system, kappa);
  StageMatrix matrix(*system);
  for (int turn = 0; turn < 4; ++turn) {
    VectorXd y = VectorXd::Zero(n), f;
    y.head(system->eta_start().size()) = system->interface(system->eta_start());
    system->evaluate({static_cast<double>(turn), kappa, 1, {}}, y, VectorXd::Zero(n), true, f);
    ASSERT_TRUE(matrix.form(op));
    const VectorXd right = VectorXd::LinSpaced(n, -1.0, 2.0);
    VectorXd x = right;
    matrix.solve(op, x);
    const MatrixXd J = dense_matrix(*system, op);
    EXPECT_LT((J * x - right).norm(), 1e-12 * (right.norm() + J.norm() * x.norm())) << turn;
  }
}

TEST(StageMatrix, ABodyWithoutAPivotOfItsOwnIsSolvedWithAllOthers) {
  // A force on a link takes what its inertia and joints give, so that J_c is 0 or nearly so where
  // the link is eliminated before its neighbours, as one of two that follow each other is.
  const double kappa = 1e-3;
  for (const double part : {1.0, 1.0 + 1e-13}) {
    int dense = 0;
    for (const int link : {30, 31}) {
      const auto plain = chain(60, true);
      const std::vector<int> at = plain->rows(link);
      const VectorXd y = plain->interface(plain->eta_start()),
                     v = VectorXd::Constant(y.size(), 0.3);
      VectorXd f;
      plain->evaluate({0.0, kappa, 1, {}}, y, v, true, f);
      const StageOperator op(*plain, kappa);
      const MatrixXd T = part * op.S(link).diagonal().cwiseInverse().asDiagonal() *
                         dense_matrix(*plain, op)(at, at);
      const auto system = chain(60, true);
      system->add_element(std::make_unique<FewSprings>(at, std::vector{0, 1, 2}, T));
      const StageMatrix matrix = checked(*system);
      ASSERT_TRUE(matrix.is_sparse());
      dense += matrix.sparse()->is_dense();
    }
    EXPECT_GE(dense, 1) << part;
  }
}

TEST(StageMatrix, SolvesAsTheDenseMatrixOfItsDefinitionDoes) {
  for (const int links : {3, 60}) {
    const auto system = chain(links, true);
    EXPECT_EQ(checked(*system).is_sparse(), links == 60);
  }
}

/// The rows that a matrix factors, once it is seen to solve as that of its definition.
int factored(const System& system, int expected_touched) {
  const int n = system.interface_size();
  const StageOperator op(system, 0.3);
  StageMatrix matrix(system);
  EXPECT_TRUE(matrix.form(op));
  EXPECT_EQ(matrix.touched(), expected_touched);
  MatrixXd T = MatrixXd::Zero(n, n);
  for (int e = 0; e < system.elements(); ++e)
    T(system.tangent_rows(e), system.tangent_rows(e)) += system.response(e).tangent;
  const VectorXd right = VectorXd::LinSpaced(n, -1.0, 2.0);
  VectorXd x = right;
  matrix.solve(op, x);
  const MatrixXd J = MatrixXd::Identity(n, n) - op.S(0) * T;
  EXPECT_LT((J * x - right).norm(), 1e-12 * right.norm());
  return matrix.factored();
}

void evaluate(System& system) {
  const VectorXd ones = VectorXd::Ones(system.interface_size());
  VectorXd f;
  system.evaluate({0.0, 0.3, 1, {}}, ones, ones, true, f);
}

TEST(StageMatrix, RowsThatNothingTouchesFollowFromTheOthers) {
  // A body of 30 coupled coordinates, of which two elements touch 3 and 4 (one of them the same).
  System system;
  const std::vector<int> all = add_plate(system, 30);
  system.add_element(std::make_unique<FewSprings>(all, std::vector{2, 7, 11}, coupled(3)));
  system.add_element(std::make_unique<FewSprings>(all, std::vector{7, 20, 21, 29}, coupled(4)));
  evaluate(system);
  EXPECT_EQ(factored(system, 6), 6);
}

TEST(StageMatrix, ColumnsWithoutLoadAreNotFactored) {
  // Of five touched coordinates one has neither force nor effect, as beside an unloaded pad, and
  // one only a force that depends on another, as friction does.
  MatrixXd tangent = MatrixXd::Zero(5, 5);
  tangent.topLeftCorner(3, 3) = coupled(3);
  tangent(3, 0) = 2.0;
  System system;
  const std::vector<int> all = add_plate(system, 30);
  system.add_element(
      std::make_unique<FewSprings>(all, std::vector{2, 7, 11, 20, 29}, std::move(tangent)));
  evaluate(system);
  EXPECT_EQ(factored(system, 5), 3);
}

TEST(StageMatrix, NoLoadAtAllLeavesNothingToFactor) {
  System system;
  const std::vector<int> all = add_plate(system, 30);
  system.add_element(std::make_unique<FewSprings>(all, std::vector{2, 7}, MatrixXd::Zero(2, 2)));
  evaluate(system);
  EXPECT_EQ(factored(system, 2), 0);
}

/// A spring to a support that runs along the coordinates: it is between two of them at a time.
class RunningSpring : public ForceElement {
 public:
  RunningSpring(std::vector<int> coordinates, bool names_them)
      : ForceElement(std::move(coordinates)), names_them_(names_them) {}
  std::string name() const override { return "running spring"; }
  void evaluate(const Stage& stage, const VectorXd& y, const VectorXd&, bool with_tangent,
                Response& response) override {
    const double at = 40.0 * stage.time, stiffness = 1e7;  // every 25 ms to the next one
    const int i = static_cast<int>(at);
    const Eigen::Vector2d weights(1.0 - (at - i), at - i);
    const double force = stiffness * (1e-3 - weights.dot(y.segment<2>(i)));
    response.force.setZero(y.size());
    response.force.segment<2>(i) = force * weights;
    response.touched.clear();
    if (names_them_) response.touched = {i, i + 1};
    if (!with_tangent) return;
    const Eigen::Matrix2d tangent = -stiffness * weights * weights.transpose();
    response.tangent.setZero(names_them_ ? 2 : y.size(), names_them_ ? 2 : y.size());
    response.tangent.block<2, 2>(names_them_ ? 0 : i, names_them_ ? 0 : i) = tangent;
  }
  Power power(const VectorXd&, const VectorXd&) const override { return {}; }

 private:
  bool names_them_;
};

TEST(StageMatrix, TouchedRowsMayChangeUnderAKeptMatrix) {
  VectorXd end[2];
  long kept[2];
  for (const bool names_them : {false, true}) {
    System system;
    system.add_element(std::make_unique<RunningSpring>(add_plate(system, 30), names_them));
    StepOptions options;
    options.largest = 1e-3;
    options.first = 1e-6;
    const auto method = testing::started(system, options);
    while (method->state().time < 0.6) method->step(0.6);
    end[names_them] = method->state().y;
    kept[names_them] = method->statistics().evaluations - 2 * method->statistics().factorizations;
  }
  EXPECT_GT(kept[1], 0);
  EXPECT_GT(end[0].norm(), 1e-4);
  EXPECT_LT((end[1] - end[0]).norm(), 1e-6 * end[0].norm());
}

TEST(StageMatrix, AChainHasEntriesInProportionToItsLinks) {
  const int entries = StageMatrix(*chain(100, false)).nonzeros();
  // A link's rows are full in its own columns and those of its two neighbours, 27 entries but for
  // the ends. S couples none of them.
  EXPECT_LE(entries, 27 * 100);
  EXPECT_NEAR(StageMatrix(*chain(400, false)).nonzeros(), 4 * entries, 100);
}

TEST(StageMatrix, ATangentThatIsNotFiniteIsSaid) {
  for (const int links : {3, 60}) {
    const auto system = chain(links, true);
    VectorXd y = system->interface(system->eta_start()), f;
    y(0) = std::numeric_limits<double>::quiet_NaN();
    system->evaluate({0.0, 1e-3, 1, {}}, y, VectorXd::Zero(y.size()), true, f);
    // A bushing's tangent depends on the rotation, which is still finite, and on the force.
    StageMatrix matrix(*system);
    EXPECT_FALSE(matrix.form(StageOperator(*system, 1e-3))) << links;
  }
}

}  // namespace
}  // namespace clatter::dynamics
