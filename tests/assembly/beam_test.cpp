// SPDX-License-Identifier: GPL-3.0-or-later
// [[beam]]: stiffness and mass against closed forms, and what it is in a model.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bar_model.hpp"
#include "core/dense/solve.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/fe/beam.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

using fe::BeamElement;
using fe::BeamMatrix;
using fe::BeamSection;
using fe::MassForm;
using test::expect_parts;

constexpr double kE = 210e9, kG = 80e9, kRho = 7850.0;

/// Steel, 20 mm along y and 30 mm along z.
BeamSection bar_section(bool shear) {
  const double b = 0.02, h = 0.03, A = b * h;
  const double I1 = h * b * b * b / 12.0, I2 = b * h * h * h / 12.0;
  const double compliance = shear ? 1.0 / (5.0 / 6.0 * kG * A) : 0.0;
  return {.EA = kE * A,
          .GJ = kG * 0.7 * I1,
          .EI1 = kE * I1,
          .EI2 = kE * I2,
          .shear1 = compliance,
          .shear2 = compliance,
          .mass = kRho * A,
          .inertia1 = kRho * I1,
          .inertia2 = kRho * I2};
}

BeamElement beam_of(const BeamSection& section, double length = 0.4) {
  BeamElement beam;
  beam.length = length;
  beam.stations = {{0.0, section}};
  return beam;
}

Eigen::Matrix3d some_axes() {
  return Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
}

/// Motions of both nodes when the beam from `a` moves as a rigid body.
Eigen::Matrix<double, 12, 6> rigid_motions(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix<double, 12, 6> R = Eigen::Matrix<double, 12, 6>::Zero();
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d& x = end == 0 ? a : b;
    for (int d = 0; d < 3; ++d) {
      R(6 * end + d, d) = 1.0;
      R(6 * end + 3 + d, 3 + d) = 1.0;
      R.block<3, 1>(6 * end, 3 + d) = Eigen::Vector3d::Unit(d).cross(x);
    }
  }
  return R;
}

/// Displacements of node b, node a held, by forces and moments on it.
Eigen::VectorXd tip_by(const BeamMatrix& K, const Eigen::VectorXd& force) {
  return dense::solve_symmetric(K.bottomRightCorner<6, 6>(), force);
}

TEST(Beam, CantileverBendsByTimoshenkosFormula) {
  const BeamSection s = bar_section(true);
  const BeamElement beam = beam_of(s);
  const double L = beam.length;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(6);
  force << 1e3, 200.0, -300.0, 5.0, 7.0, 11.0;
  const Eigen::VectorXd u = tip_by(fe::beam_stiffness(beam), force);
  Eigen::VectorXd want(6);
  want << 1e3 * L / s.EA,
      200.0 * (L * L * L / (3.0 * s.EI1) + L * s.shear1) + 11.0 * L * L / (2.0 * s.EI1),
      -300.0 * (L * L * L / (3.0 * s.EI2) + L * s.shear2) - 7.0 * L * L / (2.0 * s.EI2),
      5.0 * L / s.GJ, 300.0 * L * L / (2.0 * s.EI2) + 7.0 * L / s.EI2,
      200.0 * L * L / (2.0 * s.EI1) + 11.0 * L / s.EI1;
  EXPECT_LT((u - want).cwiseAbs().cwiseQuotient(want.cwiseAbs()).maxCoeff(), 1e-12);
}

TEST(Beam, EulerMassIsTheTextbooks) {
  BeamSection s = bar_section(false);
  s.inertia1 = s.inertia2 = 0.0;
  const BeamElement beam = beam_of(s);
  const double m = s.mass * beam.length, L = beam.length;
  const BeamMatrix M = fe::beam_mass(beam, MassForm::kConsistent);
  EXPECT_NEAR(M(0, 0), m / 3.0, 1e-12 * m);
  EXPECT_NEAR(M(0, 6), m / 6.0, 1e-12 * m);
  EXPECT_NEAR(M(1, 1), 156.0 * m / 420.0, 1e-12 * m);
  EXPECT_NEAR(M(1, 5), 22.0 * L * m / 420.0, 1e-12 * m);
  EXPECT_NEAR(M(5, 5), 4.0 * L * L * m / 420.0, 1e-12 * m);
  EXPECT_NEAR(M(1, 7), 54.0 * m / 420.0, 1e-12 * m);
  EXPECT_NEAR(M(5, 11), -3.0 * L * L * m / 420.0, 1e-12 * m);
}

// Of an unsymmetric, tapered section with offsets along skew axes.
TEST(Beam, RigidMotionsHaveNoForceAndTheMassOfTheBody) {
  BeamElement beam = beam_of(bar_section(true));
  beam.stations[0].section.EI12 = 0.4 * beam.stations[0].section.EI1;
  beam.stations.push_back({1.0, bar_section(true)});
  beam.stations[1].section.mass *= 0.5;
  beam.axes = some_axes();
  beam.offset = {Eigen::Vector3d(0.01, 0.02, -0.03), Eigen::Vector3d(-0.02, 0.01, 0.04)};
  const Eigen::Vector3d a(1.0, 2.0, 3.0);
  const Eigen::Vector3d end_a = a + beam.offset[0], end_b = end_a + beam.length * beam.axes.col(0);
  const Eigen::Matrix<double, 12, 6> R = rigid_motions(a, end_b - beam.offset[1]);
  const BeamMatrix K = fe::beam_stiffness(beam);
  EXPECT_LT((K * R).cwiseAbs().maxCoeff(), 1e-13 * (K.cwiseAbs() * R.cwiseAbs()).maxCoeff());
  for (const MassForm form : {MassForm::kConsistent, MassForm::kHrz}) {
    const Eigen::Matrix<double, 6, 6> M = R.transpose() * fe::beam_mass(beam, form) * R;
    const double mass = 0.75 * bar_section(true).mass * beam.length;
    EXPECT_NEAR(M(0, 0), mass, 1e-12 * mass);
    // Centre of a mass per length that falls to half: 4/9 of the length from a.
    const Eigen::Vector3d centre = end_a + 4.0 / 9.0 * beam.length * beam.axes.col(0);
    EXPECT_NEAR(M(1, 5), mass * centre.x(), 1e-12 * mass * centre.norm());
    EXPECT_NEAR(M(0, 4), mass * centre.z(), 1e-12 * mass * centre.norm());
  }
}

// A section turned by an angle in its plane is the section with turned axes.
TEST(Beam, ProductOfInertiaTurnsThePrincipalAxes) {
  const double angle = 0.4, c = std::cos(angle), s = std::sin(angle);
  const BeamSection principal = bar_section(false);
  BeamElement turned = beam_of(principal), given = beam_of(principal);
  turned.axes = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const auto transform = [&](double I1, double I2, double& i1, double& i2, double& i12) {
    i1 = c * c * I1 + s * s * I2;
    i2 = s * s * I1 + c * c * I2;
    i12 = s * c * (I1 - I2);
  };
  BeamSection& g = given.stations[0].section;
  transform(principal.EI1, principal.EI2, g.EI1, g.EI2, g.EI12);
  transform(principal.inertia1, principal.inertia2, g.inertia1, g.inertia2, g.inertia12);
  const BeamMatrix K = fe::beam_stiffness(turned), M = fe::beam_mass(turned, MassForm::kConsistent);
  EXPECT_LT((fe::beam_stiffness(given) - K).cwiseAbs().maxCoeff(), 1e-12 * K.cwiseAbs().maxCoeff());
  EXPECT_LT((fe::beam_mass(given, MassForm::kConsistent) - M).cwiseAbs().maxCoeff(),
            1e-12 * M.cwiseAbs().maxCoeff());
}

TEST(Beam, TaperedBarStretchesByTheLogarithm) {
  BeamElement beam = beam_of(bar_section(false));
  beam.stations.push_back({1.0, beam.stations[0].section});
  beam.stations[1].section.EA *= 0.5;
  const double EA = beam.stations[0].section.EA;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(6);
  force(0) = 1.0;
  EXPECT_NEAR(tip_by(fe::beam_stiffness(beam), force)(0) * EA / beam.length, 2.0 * std::log(2.0),
              1e-7);
}

TEST(Beam, ReleasedEndsCarryNoMoment) {
  BeamElement beam = beam_of(bar_section(false));
  beam.released = {std::vector<int>{5}, std::vector<int>{5}};
  const BeamMatrix K = fe::beam_stiffness(beam);
  EXPECT_EQ(K.row(5).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LT(std::abs(K(1, 1)), 1e-12 * K(2, 2));  // a link in the plane x y
  beam.released = {std::vector<int>{}, std::vector<int>{5}};
  const BeamSection& s = beam.stations[0].section;
  EXPECT_NEAR(fe::beam_stiffness(beam)(7, 7) * std::pow(beam.length, 3) / s.EI1, 3.0, 1e-10);
  beam.released = {std::vector<int>{3}, std::vector<int>{3}};
  expect_parts(test::refusal_of([&] { fe::beam_stiffness(beam); }),
               {"released DoFs leave it a motion without stiffness"});
}

TEST(Beam, TrussCarriesForceAlongItselfAlone) {
  const BeamElement truss = beam_of({.EA = 1e6, .mass = 2.0}, 0.5);
  BeamMatrix K = BeamMatrix::Zero();
  K(0, 0) = K(6, 6) = 2e6;
  K(0, 6) = K(6, 0) = -2e6;
  EXPECT_LT((fe::beam_stiffness(truss) - K).cwiseAbs().maxCoeff(), 1e-8);
  const BeamMatrix M = fe::beam_mass(truss, MassForm::kConsistent);
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR(M(d, d), 1.0 / 3.0, 1e-14);
    EXPECT_NEAR(M(d, d + 6), 1.0 / 6.0, 1e-14);
  }
}

/// First three bending frequencies [Hz] in the plane x y of a free bar of n beams.
Eigen::Vector3d free_bar(int n, bool shear) {
  const double a = 0.02, A = a * a, I = A * A / 12.0, G = kE / 2.6;
  const BeamSection s{.EA = kE * A,
                      .GJ = G * I,
                      .EI1 = kE * I,
                      .EI2 = kE * I,
                      .shear1 = shear ? 1.0 / (5.0 / 6.0 * G * A) : 0.0,
                      .mass = kRho * A,
                      .inertia1 = shear ? kRho * I : 0.0};
  const BeamElement beam = beam_of(s, 0.4 / n);
  const BeamMatrix K = fe::beam_stiffness(beam), M = fe::beam_mass(beam, MassForm::kConsistent);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2), m = k;
  const std::vector<int> plane = {1, 5, 7, 11};
  for (int e = 0; e < n; ++e) {
    k.block<4, 4>(2 * e, 2 * e) += K(plane, plane);
    m.block<4, 4>(2 * e, 2 * e) += M(plane, plane);
  }
  const Eigen::VectorXd w2 =
      dense::symmetric_eigen(k, m, dense::EigenParts::kValues).values.segment(2, 3);
  return w2.cwiseSqrt() / (2.0 * std::numbers::pi);
}

// Free steel bar of 400 mm, 20 x 20 mm: roots of cos cosh = 1, and 60 exact elements of another
// program for Timoshenko's theory (E 210 GPa, nu 0.3, 7850 kg/m3, kappa 5/6).
TEST(BeamOrder, FrequenciesConvergeToTheClosedForm) {
  const Eigen::Vector3d root(4.730040745, 7.853204624, 10.995607838);
  const double scale = std::sqrt(kE * 0.02 * 0.02 / 12.0 / kRho) / (2.0 * std::numbers::pi * 0.16);
  const Eigen::Vector3d euler = scale * root.cwiseAbs2();
  const auto error = [&](int n) {
    return (free_bar(n, false) - euler).cwiseQuotient(euler).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(error(16), 2e-4);
  EXPECT_NEAR(std::log2(error(8) / error(16)), 4.0, 0.3);
  EXPECT_NEAR(euler(0), 664.6, 0.1);
  const Eigen::Vector3d timoshenko(658.602, 1786.002, 3422.290);
  const Eigen::Vector3d found = free_bar(60, true);
  EXPECT_LT((found - timoshenko).cwiseQuotient(timoshenko).cwiseAbs().maxCoeff(), 1e-5);
}

// Across the block in a skew direction; against a spring between the same nodes.
TEST(HardF16_BarsOfSolids, SpinWithoutStiffnessAndCarryForceAlongThemselves) {
  mesh::Mesh mesh = bar();
  mesh.node_sets["foot"] = {mesh.node_sets.at("z0").front()};
  mesh.node_sets["head"] = {*std::ranges::max_element(
      mesh.node_sets.at("z1"), {},
      [&](int32_t node) { return 2.0 * mesh.nodes(node, 0) + mesh.nodes(node, 1); })};
  const Eigen::Vector3d along =
      (mesh.nodes.row(mesh.node_sets["head"][0]) - mesh.nodes.row(mesh.node_sets["foot"][0]));
  const double k = kE * 1e-4 / along.norm();
  const Eigen::Vector3d d = along.normalized();
  std::string spring = fmt::format("[[spring]]\nstiffness = {}\nterms = [", k);
  for (int i = 0; i < 3; ++i)
    for (const auto& [set, sign] : {std::pair("head", 1.0), std::pair("foot", -1.0)})
      spring += fmt::format("{{ node_set = \"{}\", direction = \"{}\", coefficient = {} }},", set,
                            "xyz"[i], sign * d[i]);
  const fe::FeModel beam = build(mesh, R"(
[[point]]
name = "a"
node_set = "foot"
[[point]]
name = "b"
node_set = "head"
[[beam]]
points = ["a", "b"]
E = 210e9
y = [1.0, 0.0, 0.0]
sections = [ { area = 1e-4, I1 = 1e-9, I2 = 1e-9 } ]
)")
                               .model;
  const fe::FeModel spring_model = build(mesh, spring + "]\n").model;
  const auto frequencies = [](const fe::FeModel& model) {
    const Eigen::MatrixXd K = full(model.K), M = full(model.M);
    // Rotations of the points have no mass: eliminated by their stiffness.
    std::vector<int> massive, massless;
    for (int i = 0; i < M.rows(); ++i) (M(i, i) > 0.0 ? massive : massless).push_back(i);
    Eigen::MatrixXd S = K(massive, massive);
    if (!massless.empty())
      S -= K(massive, massless) *
           dense::solve_symmetric(K(massless, massless), K(massless, massive));
    return dense::symmetric_eigen(S, M(massive, massive), dense::EigenParts::kValues).values;
  };
  EXPECT_EQ(beam.size(), spring_model.size() + 4);  // two rotations of each point
  const Eigen::VectorXd found = frequencies(beam), want = frequencies(spring_model);
  EXPECT_LT(found.head(6).cwiseAbs().maxCoeff(), 1e-9 * want(6));
  EXPECT_LT((found - want).segment(6, 6).cwiseAbs().cwiseQuotient(want.segment(6, 6)).maxCoeff(),
            kSolve);
}

constexpr const char* kEnds =
    "[[point]]\nname = \"a\"\nat = [0.05, 0.05, 0.3]\n[[point]]\nname = \"b\"\n"
    "at = [0.05, 0.05, 0.7]\n"
    "[[coupling]]\ntype = \"rigid\"\npoint = \"a\"\nsurface = \"z1\"\n";

// On a block that yields: relative to the point that the block carries it is a cantilever.
TEST(Beam, OnAPartIsACantileverOnItsPoint) {
  const fe::FeModel model = build(bar(), std::string(kFoot) + kEnds + R"(
[[beam]]
points = ["a", "b"]
E = 210e9
G = 80e9
rho = 7850
shear_factors = [0.8, 0.9]
y = [1, 1, 0]
sections = [ { area = 6e-4, I1 = 2e-8, I2 = 4.5e-8, J = 1.4e-8, line_mass = 0.5 } ]
)")
                                .model;
  const Eigen::Index nodal = model.T.rows();
  Eigen::VectorXd f = Eigen::VectorXd::Zero(nodal + 12);
  const Eigen::Vector3d force(300.0, 500.0, 40.0);  // at b
  f.segment<3>(nodal + 6) = force;
  const Eigen::VectorXd u = solve_model(model, f);
  const Eigen::Vector3d arm(0.0, 0.0, 0.4);
  const Eigen::Vector3d turned = u.segment<3>(nodal + 3);
  const Eigen::Vector3d bent = u.segment<3>(nodal + 6) - u.segment<3>(nodal) - turned.cross(arm);
  const Eigen::Vector3d y = Eigen::Vector3d(1, 1, 0).normalized(),
                        z = Eigen::Vector3d(-1, 1, 0).normalized();
  const double L3 = 0.064 / 3.0;
  const Eigen::Vector3d want = y * y.dot(force) * (L3 / (kE * 2e-8) + 0.4 / (0.8 * kG * 6e-4)) +
                               z * z.dot(force) * (L3 / (kE * 4.5e-8) + 0.4 / (0.9 * kG * 6e-4)) +
                               Eigen::Vector3d(0.0, 0.0, 40.0 * 0.4 / (kE * 6e-4));
  EXPECT_LT((bent - want).norm(), kSolve * want.norm());
}

std::string refusal(const std::string& toml) {
  return test::refusal_of([&] { build(bar(), kEnds + toml); });
}

TEST(Beam, IsRefusedWithThePlaceAndTheWayOut) {
  const std::string head = "[[beam]]\npoints = [\"a\", \"b\"]\nE = 2.1e11\n";
  expect_parts(refusal(head), {"sections", "found none"});
  expect_parts(refusal(head + "sections = [ {} ]\n"), {"without area, I1, I2 and J"});
  expect_parts(refusal(head + "sections = [ { J = 1e-8 } ]\n"), {"G: is missing, J needs it"});
  expect_parts(refusal(head + "sections = [ { area = 1e-4, I1 = 1e-9, I2 = 2e-9 } ]\n"),
               {"y: is missing"});
  expect_parts(refusal(head + "y = [0, 0, 1]\nsections = [ { area = 1e-4, I1 = 1e-9 } ]\n"),
               {"y: is parallel to the beam"});
  expect_parts(
      refusal(head + "y = [1, 0, 0]\nsections = [ { I1 = 1e-9, I2 = 1e-9, I12 = 2e-9 } ]\n"),
      {"I12", "below I1 I2"});
  expect_parts(refusal(head + "sections = [ { area = 1e-4 }, { at = 0.5, area = 1e-4 } ]\n"),
               {"the first at 0 and the last at 1"});
  expect_parts(refusal("[[beam]]\npoints = [\"a\", \"c\"]\nE = 1.0\nsections = [ { area = 1 } ]\n"),
               {"points", "found \"c\""});
  expect_parts(refusal(head + "released_b = \"x\"\nreleased_a = \"x\"\ny = [1, 0, 0]\n"
                              "sections = [ { area = 1e-4 } ]\n"),
               {"beam beam_1", "without stiffness"});
}

}  // namespace
}  // namespace clatter::assembly::testing
