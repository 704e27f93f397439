// SPDX-License-Identifier: GPL-3.0-or-later
// The acoustic skin and the map of normal velocity onto it.
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "core/sound/far_harmonics.hpp"
#include "core/sound/radiation.hpp"
#include "recover/acoustic/acoustic_skin.hpp"
#include "recover/acoustic/skin_border.hpp"
#include "recover/acoustic/velocity_map.hpp"
#include "synthetic.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;

constexpr double kSpeed = 343.2;

rom::Skin skin_of(const Mesh6& mesh) {
  return {mesh.nodes, mesh.triangles, random_rows(mesh, 2, 1)};
}

Exposure everywhere(const Mesh6& mesh) {
  return {std::vector<bool>(static_cast<size_t>(mesh.triangles.rows()), true), {}};
}

sound::Surface wrap_of(const Mesh6& mesh, double to_hz) {
  return acoustic_skin(skin_of(mesh), {.opening = 0.05}, kSpeed, to_hz).surface;
}

TEST(AcousticSkin, HollowBoxIsWrappedByAClosedSurfaceWithoutItsHole) {
  const sound::Surface wrap = wrap_of(hollow_box({0.4, 0.3, 0.2}, 3), 1500.0);
  EXPECT_GE(sound::mesh_limit_hz(wrap, kSpeed, AcousticMesh{}.edges_per_wavelength), 1500.0);
  // The wrap lies a sixtieth of the opening outside: 1.2 % of the area, and rounds the edges.
  EXPECT_NEAR(wrap.area / (2 * (0.12 + 0.08 + 0.06)), 1.0, 0.02);
  EXPECT_NEAR(wrap.volume / 0.024, 1.0, 0.03);
}

TEST(AcousticSkin, FinerMeshForAHigherFrequency) {
  const Mesh6 mesh = box({0.4, 0.3, 0.2}, 2);
  const auto coarse = wrap_of(mesh, 1000.0), fine = wrap_of(mesh, 2000.0);
  EXPECT_GT(fine.face_count(), 2.5 * static_cast<double>(coarse.face_count()));
}

TEST(AcousticSkin, BodyWithoutSkinOrSmallerThanTheOpeningIsRefused) {
  test::expect_parts(test::refusal_of([] { acoustic_skin(rom::Skin{}, {}, kSpeed, 1000.0); }),
                     {"acoustic skin: found a reduced model without a skin"});
  test::expect_parts(
      test::refusal_of([] {
        acoustic_skin(skin_of(box({0.1, 0.1, 0.1}, 1)), {.opening = 0.2}, kSpeed, 1000.0);
      }),
      {"found openings of 0.2 m", "the size of the body, 0.173 m"});
}

TEST(AcousticSkin, BorderOfAnOpenSkinIsMeasured) {
  Mesh6 mesh = box({0.4, 0.3, 0.2}, 2);
  EXPECT_EQ(skin_border(skin_of(mesh)).edges, 0);
  const IndexMatrix all = mesh.triangles;
  mesh.triangles = all.bottomRows(all.rows() - 2);  // without a square of the side x = 0
  const SkinBorder border = skin_border(skin_of(mesh));
  EXPECT_EQ(border.edges, 4);
  EXPECT_NEAR(border.widest, 0.15, 1e-12);
  test::expect_parts(
      test::refusal_of([&] { acoustic_skin(skin_of(mesh), {.opening = 0.1}, kSpeed, 1000.0); }),
      {"found a skin that is open along 4 edges, 0.15 m wide", "openings up to 0.1 m"});
  // A wrap that cannot enter closes the hole.
  const auto closed = acoustic_skin(skin_of(mesh), {.opening = 0.2}, kSpeed, 1000.0).surface;
  EXPECT_NEAR(closed.volume / 0.024, 1.0, 0.1);
}

/// Velocity x at the nodes: a body that swells by 3 times its volume a second.
Eigen::VectorXd swelling(const Mesh6& mesh) {
  Eigen::VectorXd u(mesh.nodes.size());
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n)
    u.segment(3 * n, 3) = mesh.nodes.row(n).transpose();
  return u;
}

/// Flux out of the acoustic skin [m3/s].
double flux(const sound::Surface& wrap, const Eigen::VectorXd& v) {
  double sum = 0.0;
  for (Eigen::Index c = 0; c < wrap.face_count(); ++c)
    sum += wrap.face_area[c] / 3.0 * v.segment(3 * c, 3).sum();
  return sum;
}

TEST(VelocityMap, KeepsTheFluxOfASwellingBoxAndOfRigidMotions) {
  const Mesh6 mesh = box({0.4, 0.3, 0.2}, 6);
  const sound::Surface wrap = wrap_of(mesh, 1500.0);
  const Exposure all = everywhere(mesh);
  const VelocityMap map = velocity_map(skin_of(mesh), all, wrap, LidMotion::kRest);
  EXPECT_NEAR(flux(wrap, map.map * swelling(mesh)), 3.0 * 0.024, 1e-14);
  EXPECT_LT(map.errors.flux, 1e-14);
  EXPECT_LT(map.errors.velocity, 0.12);  // at the rounded edges
  // Nothing is open; a face that cuts an edge of the box may face the body with less than half.
  EXPECT_LT(map.lid_area, 1e-3 * wrap.area);
}

TEST(VelocityMap, IsExactForASphere) {
  Mesh6 mesh = unit_sphere(3);
  mesh.nodes *= 0.2;
  const sound::Surface wrap = wrap_of(mesh, 2000.0);
  const Exposure all = everywhere(mesh);
  const VelocityMap map = velocity_map(skin_of(mesh), all, wrap, LidMotion::kRest);
  EXPECT_NEAR(flux(wrap, map.map * swelling(mesh)), 4.0 * std::numbers::pi * 0.008, 1e-5);
  EXPECT_LT(map.errors.velocity, 0.05);
}

TEST(VelocityMap, APointSourceInsideTheBodySendsItsPowerThroughMapAndBoundaryElements) {
  // Velocities of p = exp(-i k r) / r at the nodes of a box with sharp edges: P = 2 pi / (rho c).
  const Mesh6 mesh = box({0.4, 0.3, 0.2}, 8);
  const sound::Surface wrap = wrap_of(mesh, 1500.0);
  const Exposure all = everywhere(mesh);
  const VelocityMap map = velocity_map(skin_of(mesh), all, wrap, LidMotion::kRest);
  const sound::Fluid air{1.204, kSpeed};
  const Eigen::Vector3d source =
      mesh.nodes.colwise().mean().transpose() + Eigen::Vector3d(.05, -.03, .02);
  for (const double hz : {200.0, 1500.0}) {
    const double k = 2.0 * std::numbers::pi * hz / kSpeed;
    const std::complex<double> i(0.0, 1.0);
    Eigen::VectorXcd u(mesh.nodes.size());
    for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) {
      const Eigen::Vector3d d = mesh.nodes.row(n).transpose() - source;
      const double r = d.norm();
      const std::complex<double> p = std::exp(-i * k * r) / r;
      u.segment(3 * n, 3) = p * (i * k + 1.0 / r) / (i * k * kSpeed * air.density * r) * d;
    }
    Eigen::VectorXcd v(map.map.rows());
    v.real() = map.map * Eigen::VectorXd(u.real());
    v.imag() = map.map * Eigen::VectorXd(u.imag());
    const auto state = sound::radiate(wrap, {air}, hz, v);
    const double exact = 2.0 * std::numbers::pi / (air.density * kSpeed);
    EXPECT_NEAR(sound::surface_power(wrap, state)(0) / exact, 1.0, 0.01) << hz;
  }
}

/// Flows of two groups of faces add up to int N_n v_n dS of the map's velocities.
void expect_flows_of_the_map(const Mesh6& mesh, const sound::Surface& wrap,
                             const VelocityMap& map) {
  const rom::Skin skin = skin_of(mesh);
  std::vector<int32_t> group;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) group.push_back(f % 3 == 0 ? 1 : 0);
  const std::vector<RowMatrix> flows =
      group_flows(map.flow, skin.triangles, rom::SkinRows(skin.T), group, 2, wrap.node_count());
  const Eigen::MatrixXcd velocity =
      (map.map * Eigen::MatrixXd(skin.T)).cast<std::complex<double>>();
  const Eigen::MatrixXd whole = sound::node_flow(wrap, velocity).real();
  EXPECT_LT((flows[0] + flows[1] - whole).norm(), 1e-12 * whole.norm());
  EXPECT_GT(flows[1].norm(), 0.1 * whole.norm());
  EXPECT_TRUE(std::is_sorted(map.flow.face.begin(), map.flow.face.end()));
}

TEST(VelocityMap, LidsRestOrMoveWithTheNearestFace) {
  const Mesh6 mesh = box({0.4, 0.3, 0.2}, 6);
  const sound::Surface wrap = wrap_of(mesh, 1500.0);
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  Exposure exposed;  // all but the top
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    exposed.front.push_back(geometry.face_normal(f, 2) < 0.9);
  Eigen::VectorXd lift = Eigen::VectorXd::Zero(mesh.nodes.size());
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) lift[3 * n + 2] = 1.0;
  const auto mapped = [&](LidMotion motion) {
    return velocity_map(skin_of(mesh), exposed, wrap, motion);
  };
  for (const LidMotion motion : {LidMotion::kRest, LidMotion::kNearest})
    expect_flows_of_the_map(mesh, wrap, mapped(motion));
  const VelocityMap rest = mapped(LidMotion::kRest), moving = mapped(LidMotion::kNearest);
  EXPECT_NEAR(rest.lid_area, 0.12, 0.012);
  EXPECT_NEAR(flux(wrap, rest.map * lift), -0.12, 1e-14);        // the bottom's alone
  EXPECT_NEAR(flux(wrap, moving.map * lift), 0.0, 0.05 * 0.12);  // the lid's as well
  test::expect_parts(test::refusal_of([&] {
                       velocity_map(skin_of(mesh),
                                    {std::vector<bool>(exposed.front.size(), false), {}}, wrap,
                                    LidMotion::kRest);
                     }),
                     {"acoustic skin: found no exposed face"});
}

}  // namespace
}  // namespace clatter::recover
