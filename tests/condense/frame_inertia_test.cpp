// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia of bodies whose frame accelerates and rotates, eq. (9): against the sum over partial
// masses, Euler's equations, a stretched bar and a whirling mass.
#include "condense/basis/frame_inertia.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "condense/condense.hpp"
#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/dense/complex.hpp"
#include "core/dense/solve.hpp"
#include "tests/condense/box_model.hpp"
#include "tests/condense/solid_model.hpp"
#include "tests/refusal.hpp"

namespace clatter::condense {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

rom::ReducedModel reduce_turning(const fe::FeModel& model, std::vector<std::string> boundary,
                                 int count) {
  CondenseOptions options;
  options.boundary = std::move(boundary);
  options.modes.count = count;
  options.modes.frequency_error = 0.0;
  options.skin = {};
  options.inertia_invariants = true;
  set_quiet(true);
  StepClock clock;
  return condense(model, options, clock);
}

rom::FrameMotion some_motion() {
  return {Vector3d(3.0, -5.0, 9.81), Vector3d(20.0, -50.0, 70.0), Vector3d(400.0, 900.0, -300.0)};
}

VectorXd random_vector(Eigen::Index size, double scale, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, scale);
  return VectorXd::NullaryExpr(size, [&](Eigen::Index) { return normal(generator); });
}

/// The basis of `reduce_turning`, all DoFs in the model's order.
MatrixXd full_basis(const fe::FeModel& model, const std::vector<std::string>& boundary, int count) {
  const LocalPart part(model, boundary);
  ModeRequest request;
  request.count = count;
  request.frequency_error = 0.0;
  StepClock clock;
  const CraigBampton source = craig_bampton(part, static_part(part, {}, clock), request, clock);
  MatrixXd V(model.size(), source.basis.size());
  const MatrixXd unit = MatrixXd::Identity(source.basis.size(), source.basis.size());
  V(part.dofs.interior, Eigen::all) = source.basis.interior(unit);
  V(part.dofs.boundary, Eigen::all) = unit.topRows(source.basis.boundary());
  return V;
}

TEST(FrameInertia, EqualsTheSumOfEquationNineOverPartialMasses) {
  const auto model = test::box_model();  // lumped: a diagonal M, T = I
  const rom::ReducedModel reduced = reduce_turning(model, {"left", "right"}, 12);
  const MatrixXd V = full_basis(model, {"left", "right"}, 12);
  const rom::FrameMotion motion = some_motion();
  const VectorXd q = random_vector(reduced.size(), 1e-3, 1);
  const VectorXd v = random_vector(reduced.size(), 0.5, 2);
  const VectorXd u = V * q, u_dot = V * v, m = model.M.diagonal();
  VectorXd p(model.size());
  for (Eigen::Index a = 0; a < model.nodes.rows(); ++a) {
    const Vector3d at = model.nodes.row(a).transpose() + u.segment<3>(3 * a);
    const Vector3d& w = motion.omega;
    p.segment<3>(3 * a) =
        -m[3 * a] * (motion.acceleration + motion.omega_rate.cross(at) + w.cross(w.cross(at)) +
                     2.0 * w.cross(u_dot.segment<3>(3 * a)));
  }
  const VectorXd expected = V.transpose() * p;
  EXPECT_LT((reduced.inertia.force(motion, q, v) - expected).norm(), 1e-12 * expected.norm());
  EXPECT_LT(reduced.certificate.inertia_invariants_error.value(), 1e-12);
}

/// A free bar whose ends are rigid: nodes there have no coordinates of their own.
fe::FeModel coupled_bar(const std::string& more = "") {
  return test::solid_bar({0.2, 0.03, 0.02}, {5, 2, 2}, 0.3,
                         "[[coupling]]\nname = \"a\"\nsurface = \"x0\"\ntype = \"rigid\"\n"
                         "[[coupling]]\nname = \"b\"\nsurface = \"x1\"\ntype = \"rigid\"\n" +
                             more);
}

TEST(FrameInertia, ResultantsOfASolidAreThoseOfNewtonAndEuler) {
  const rom::ReducedModel reduced = reduce_turning(coupled_bar(), {"a", "b"}, 8);
  const rom::FrameMotion motion = some_motion();
  const VectorXd p = reduced.inertia.load(motion);
  const rom::MassProperties& mass = reduced.mass;
  const Vector3d& c = mass.centre;
  const Vector3d& w = motion.omega;
  const Vector3d centre = motion.acceleration + motion.omega_rate.cross(c) + w.cross(w.cross(c));
  const Vector3d force = -mass.mass * centre;
  EXPECT_LT((reduced.rigid.leftCols(3).transpose() * p - force).norm(), 1e-10 * force.norm());
  const Vector3d spin = mass.inertia * motion.omega_rate + w.cross(mass.inertia * w);
  const Vector3d moment = c.cross(force) - spin;
  EXPECT_LT((reduced.rigid.rightCols(3).transpose() * p - moment).norm(), 1e-10 * moment.norm());
  // The same integrals computed independently from M_rr and the rigid motions.
  EXPECT_LT(reduced.certificate.inertia_invariants_error.value(), 1e-10);
}

TEST(FrameInertia, CoriolisForcesDoNoWorkAndCentrifugalOnesHaveAPotential) {
  const rom::ReducedModel reduced = reduce_turning(coupled_bar(), {"a", "b"}, 8);
  const MatrixXd G = reduced.inertia.gyroscopic({10.0, 20.0, 30.0});
  EXPECT_LT((G + G.transpose()).norm(), 1e-14 * G.norm());
  rom::FrameMotion steady = some_motion();
  steady.omega_rate.setZero();
  const MatrixXd C = reduced.inertia.softening(steady);
  EXPECT_LT((C - C.transpose()).norm(), 1e-14 * C.norm());
}

TEST(FrameInertia, ABarThatTurnsAboutItsEndStretchesAsInTheory) {
  // u(L) = rho Omega^2 L^3 / (3 E) without Poisson's contraction.
  const double L = 0.3, omega = 500.0;
  const auto model = test::solid_bar({L, 0.02, 0.02}, {12, 1, 1}, 0.0,
                                     "[[nodes]]\nname = \"foot\"\nnode_set = \"x0\"\n"
                                     "[[coupling]]\nname = \"tip\"\nsurface = \"x1\"\n");
  const rom::ReducedModel reduced = reduce_turning(model, {"foot", "tip"}, 4);
  rom::FrameMotion motion;
  motion.omega.z() = omega;
  const VectorXd p = reduced.inertia.load(motion);
  const auto held = static_cast<Eigen::Index>(reduced.set("foot").dofs.size());
  const Eigen::Index rest = reduced.size() - held;
  const MatrixXd K = reduced.K_rr.bottomRightCorner(rest, rest);
  const VectorXd q = dense::solve_symmetric(K, p.tail(rest));
  const auto tip = reduced.set("tip").dofs.front() - held;
  const double theory = 8000.0 * omega * omega * L * L * L / (3.0 * 200e9);
  EXPECT_NEAR(q[tip], theory, 1e-3 * theory);  // the nodes of x0 are also held laterally
  // Softening: the load grows with the stretch.
  const MatrixXd softer = K + reduced.inertia.softening(motion).bottomRightCorner(rest, rest);
  EXPECT_GT(dense::solve_symmetric(softer, p.tail(rest))(tip, 0), q[tip]);
}

TEST(FrameInertia, AWhirlingMassHasTheFrequenciesOmegaPlusAndMinusSpin) {
  // A point mass on equal springs, in a frame that rotates about z: |w0 +- Omega|, and w0 along the
  // axis.
  const double m = 2.0, w0 = 300.0, spin = 70.0;
  rom::InertiaInvariants mass;
  for (size_t k = 0; k < 3; ++k) {
    mass.first[k] = m * Vector3d::Unit(static_cast<int>(k));
    for (size_t l = 0; l < 3; ++l) {
      mass.moment[3 * l + k] = Vector3d::Zero();
      mass.product[3 * k + l] =
          m * Vector3d::Unit(static_cast<int>(k)) * Vector3d::Unit(static_cast<int>(l)).transpose();
    }
  }
  rom::FrameMotion motion;
  motion.omega.z() = spin;
  MatrixXd state = MatrixXd::Zero(6, 6);
  state.topRightCorner(3, 3).setIdentity();
  state.bottomLeftCorner(3, 3) = -(w0 * w0 * MatrixXd::Identity(3, 3) + mass.softening(motion) / m);
  state.bottomRightCorner(3, 3) = -mass.gyroscopic(motion.omega) / m;
  VectorXd found = dense::eigenvalues(state).imag();
  std::sort(found.begin(), found.end());
  EXPECT_LT((found.tail(3) - Vector3d(w0 - spin, w0, w0 + spin)).norm(), 1e-9 * w0);
}

TEST(FrameInertia, RoundTripsInTheFileAndOneOfAnotherMassIsRefused) {
  const std::filesystem::path path =
      std::filesystem::path(::testing::TempDir()) / "clatter_frame_inertia.rom.h5";
  const auto write = [&](const rom::ReducedModel& model) {
    H5File file = H5File::create(path);
    write_provenance(file, {"clatter/rom/1", "", {}});
    rom::write_reduced_model(file, model);
    file.commit();
  };
  rom::ReducedModel reduced = reduce_turning(test::box_model(), {"left", "right"}, 5);
  write(reduced);
  const rom::InertiaInvariants back = rom::read_reduced_model(path).inertia;
  for (size_t k = 0; k < 9; ++k) EXPECT_EQ(back.product[k], reduced.inertia.product[k]) << k;
  for (size_t k = 0; k < 9; ++k) EXPECT_EQ(back.moment[k], reduced.inertia.moment[k]) << k;
  EXPECT_EQ(back.place, reduced.inertia.place);
  reduced.inertia.product[0] *= 1.01;
  write(reduced);
  test::expect_parts(test::refusal_of([&] { rom::read_reduced_model(path); }),
                     {"inertia_invariants", "M_rr"});
}

TEST(BadInput, InertiaInvariantsOfAMassThatIsNotTheCellsAreRefused) {
  const auto model = coupled_bar("[[point_mass]]\non = \"a\"\nmass = 0.5\n");
  test::expect_parts(test::refusal_of([&] {
                       reduce_turning(model, {"a", "b"}, 4);
                     }),
                     {"inertia_invariants", "point masses"});
}

}  // namespace
}  // namespace clatter::condense
