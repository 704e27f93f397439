// SPDX-License-Identifier: GPL-3.0-or-later
// Closed surfaces: measures and refusals.
#include "core/sound/surface.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "bodies.hpp"
#include "tests/refusal.hpp"

namespace clatter::sound {
namespace {

using namespace testing;

std::string refusal(const RowMatrix& nodes, const IndexMatrix& triangles) {
  return test::refusal_of([&] { closed_surface(nodes, triangles); });
}

/// Two surfaces as one.
Triangles both(const Surface& a, const Surface& b) {
  Triangles out{RowMatrix(a.node_count() + b.node_count(), 3),
                IndexMatrix(a.face_count() + b.face_count(), 3)};
  out.nodes << a.nodes, b.nodes;
  out.faces << a.triangles, (b.triangles.array() + static_cast<int32_t>(a.node_count())).matrix();
  return out;
}

TEST(Surface, BoxHasItsMeasures) {
  const Surface surface = box({0.3, 0.2, 0.1}, 0.1);
  EXPECT_EQ(surface.face_count(), 2 * 2 * (6 + 3 + 2));
  EXPECT_NEAR(surface.area, 2 * (0.06 + 0.03 + 0.02), 1e-15);
  EXPECT_NEAR(surface.volume, 0.006, 1e-16);
  EXPECT_LT(surface.middle.norm(), 1e-16);
  EXPECT_NEAR(surface.radius, 0.5 * std::sqrt(0.14), 1e-15);
  EXPECT_NEAR(surface.longest_edge, 0.1 * std::sqrt(2.0), 1e-15);
  // Each face has two edges of 0.1 and one diagonal.
  EXPECT_NEAR(surface.mean_edge, 0.1 * std::sqrt(4.0 / 3.0), 1e-15);
  EXPECT_NEAR(mesh_limit_hz(surface, 343.2, 6.0), 343.2 / (6.0 * surface.mean_edge), 1e-9);
  const Eigen::Vector3d flux = surface.face_normal.transpose() * surface.face_area;
  EXPECT_LT(flux.norm(), 1e-16);
}

TEST(Surface, WindingNumberIsOneInsideAndZeroOutside) {
  const Surface surface = bent_egg(1);
  EXPECT_NEAR(winding_number(surface, {0.1, 0.0, 0.05}), 1.0, 1e-14);
  EXPECT_NEAR(winding_number(surface, {0.6, 0.0, 0.0}), 0.0, 1e-14);
}

TEST(Surface, DistanceIsToFacesEdgesAndCorners) {
  const Surface surface = box({2, 2, 2}, 1.0);
  EXPECT_NEAR(distance_to(surface, {0.3, -0.2, 1.5}), 0.5, 1e-15);
  EXPECT_NEAR(distance_to(surface, {1.3, 1.4, 0.1}), 0.5, 1e-15);
  EXPECT_NEAR(distance_to(surface, {2, 3, -3}), 3.0, 1e-15);
  EXPECT_NEAR(distance_to(surface, {0.9, 0.1, 0.2}), 0.1, 1e-15);  // from inside
  EXPECT_NEAR(distance_to(surface, {1, 0.1, 0.2}), 0.0, 1e-15);
}

TEST(Surface, SeveralShellsAreOneSurface) {
  const Surface one = box({1, 1, 1}, 1.0);
  Triangles two = both(one, one);
  two.nodes.bottomRows(one.node_count()).col(0).array() += 3.0;
  EXPECT_NEAR(closed_surface(two.nodes, two.faces).volume, 2.0, 1e-14);
}

TEST(Surface, HoleFlippedFaceAndInsideOutAreRefused) {
  const Surface surface = box({1, 1, 1}, 1.0);
  test::expect_parts(refusal(surface.nodes, surface.triangles.topRows(11)),
                     {"surface: edge (", "found no face on its other side", "a closed surface"});
  IndexMatrix flipped = surface.triangles;
  std::swap(flipped(5, 1), flipped(5, 2));
  test::expect_parts(refusal(surface.nodes, flipped),
                     {"found in the same direction in faces", "and 5"});
  IndexMatrix inside_out = surface.triangles;
  inside_out.col(1).swap(inside_out.col(2));
  test::expect_parts(refusal(surface.nodes, inside_out),
                     {"the shell of face 0: found an enclosed volume of -1 m3"});
}

TEST(Surface, CavityIsRefused) {
  const Surface outer = box({1, 1, 1}, 1.0), inner = box({0.5, 0.5, 0.5}, 1.0);
  Triangles hollow = both(outer, inner);
  hollow.faces.bottomRows(12).col(1).swap(hollow.faces.bottomRows(12).col(2));
  test::expect_parts(refusal(hollow.nodes, hollow.faces),
                     {"the shell of face 12", "-0.125 m3", "no cavity"});
}

TEST(Surface, BadTablesAreRefused) {
  const Surface surface = box({1, 1, 1}, 1.0);
  RowMatrix nodes = surface.nodes;
  nodes(3, 1) = std::numeric_limits<double>::quiet_NaN();
  test::expect_parts(refusal(nodes, surface.triangles),
                     {"surface: node 3: found a coordinate that is not finite"});
  nodes = surface.nodes;
  nodes.conservativeResize(9, 3);
  nodes.row(8).setZero();
  test::expect_parts(refusal(nodes, surface.triangles), {"node 8: found no face with it"});
  IndexMatrix triangles = surface.triangles;
  triangles(4, 0) = 8;
  test::expect_parts(refusal(surface.nodes, triangles), {"face 4: found node 8, expected 0 to 7"});
  nodes = surface.nodes;
  for (int a = 1; a < 3; ++a)
    nodes.row(surface.triangles(2, a)) = nodes.row(surface.triangles(2, 0));
  test::expect_parts(refusal(nodes, surface.triangles), {"found corners on a line (area 0 m2)"});
  test::expect_parts(refusal(surface.nodes, IndexMatrix(0, 3)), {"found nodes", "0 faces"});
}

}  // namespace
}  // namespace clatter::sound
