// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/coupling/contact_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "assembly/load/load_case.hpp"
#include "block_mesh.hpp"
#include "core/base/error.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

mesh::Mesh liner(int around = 24, int along = 6) {
  BlockOptions options;
  options.curved = options.wrap_x = true;
  return block_mesh({around, 1, along}, ring(0.05, 0.06, 0.12), options);
}

std::string liner_contact(int strips, int rows) {
  return "[[contact]]\nname = \"liner\"\nsurface = \"y0\"\naxis_point = [0.0, 0.0, 0.0]\n"
         "axis = [0.0, 0.0, 1.0]\nzero_angle = [0.0, 1.0, 0.0]\naxial = [0.0, 0.12]\nrows = " +
         std::to_string(rows) +
         "\n[[contact.sector]]\ncentre_deg = 0.0\nhalf_width_deg = 40.0\nstrips = " +
         std::to_string(strips) +
         "\n[[contact.sector]]\ncentre_deg = 180.0\nhalf_width_deg = 40.0\nstrips = " +
         std::to_string(strips) + "\n";
}

PatchGridSpec whole_circle(int strips, int rows) {
  PatchGridSpec spec;
  spec.sectors = {{0.0, 2.0 * std::numbers::pi, strips}};
  spec.axial_edges = Eigen::VectorXd::LinSpaced(rows + 1, 0.0, 0.12);
  return spec;
}

TEST(ContactPatch, BreathingOfTheBoreMovesEveryPatchOutwards) {
  const mesh::Mesh mesh = liner();
  const BuiltModel built = build(mesh, liner_contact(3, 4));
  const rom::DofSet& set = built.model.set("liner");
  const rom::ContactGrid& grid = built.model.grids.at("liner");
  ASSERT_EQ(set.dofs.size(), 24u);
  EXPECT_NEAR(grid.radius, 0.05, 1e-5);  // parabolic arcs: h^4
  EXPECT_EQ(grid.angle.size(), 6);
  EXPECT_EQ(set.labels[5], "liner[1,1]");
  // Angle 0 is +y, right-handed about z: the first sector's middle strip faces +y.
  EXPECT_LT((set.direction.row(1 * 4 + 2) - Eigen::RowVector3d(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((set.direction.row(4 * 4 + 2) - Eigen::RowVector3d(0, -1, 0)).norm(), 1e-12);

  // Row of C from T: q = C u with u = T q, so check through the model's own rigid motions, and
  // the breathing field through the functionals.
  const SurfaceIntegrals s = integrate_surface(mesh.nodes, mesh.surface("y0"));
  const PatchCoupling patches = contact_patches("p", mesh.nodes, s, whole_circle(8, 3), "test");
  for (const Functional& row : patches.coupling.rows) {
    double q = 0.0;
    for (size_t k = 0; k < row.dofs.size(); ++k) {
      const Eigen::RowVector3d x = mesh.nodes.row(row.dofs[k] / 3);
      const Eigen::RowVector3d radial = Eigen::RowVector3d(x(0), x(1), 0.0).normalized();
      q += row.values[k] * 1e-6 * radial(row.dofs[k] % 3);
    }
    EXPECT_NEAR(q, 1e-6, 1e-18);
  }
}

TEST(ContactPatch, RigidMotionsOfTheGridAreThoseOfThePart) {
  const fe::FeModel model = build(liner(), liner_contact(3, 4)).model;
  const rom::DofSet& set = model.set("liner");
  for (size_t k = 0; k < set.dofs.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    // The mean of cos over a patch is a little below the cosine at its middle: sin(a) / a.
    const double want = set.direction(row, 1);
    EXPECT_NEAR(model.rigid(set.dofs[k], 1), want, 0.03);
    EXPECT_LT(std::abs(model.rigid(set.dofs[k], 2)), 1e-12);
  }
}

/// Nodal forces of 1 Pa, once through forces on the patches, once consistent: relative difference.
double pressure_difference(int around) {
  const mesh::Mesh mesh = liner(around, around / 4);
  const SurfaceIntegrals s = integrate_surface(mesh.nodes, mesh.surface("y0"));
  const PatchCoupling patches = contact_patches("p", mesh.nodes, s, whole_circle(4, 2), "test");
  Eigen::VectorXd nodal = Eigen::VectorXd::Zero(3 * mesh.nodes.rows());
  double shared_area = 0.0;
  for (const Functional& row : patches.coupling.rows) {
    std::set<int32_t> nodes;
    for (const int32_t dof : row.dofs) nodes.insert(dof / 3);
    double area = 0.0;
    for (const int32_t node : nodes)
      area += s.weight(std::lower_bound(s.nodes.begin(), s.nodes.end(), node) - s.nodes.begin());
    shared_area += area;
    for (size_t k = 0; k < row.dofs.size(); ++k) nodal(row.dofs[k]) += area * row.values[k];
  }
  EXPECT_NEAR(shared_area / s.area, 1.0, 1e-12);  // all area is shared out
  const Eigen::VectorXd pressure = pressure_load(mesh.nodes.rows(), s);
  return (nodal - pressure).norm() / pressure.norm();
}

TEST(ContactPatch, PatchForcesOfAUniformPressureTendToItsNodalForces) {
  const double coarse = pressure_difference(16), fine = pressure_difference(32);
  EXPECT_LT(fine, 0.005);
  // The radius of the node represents the normal around it: second order, first order at nodes on
  // the edge of the surface, whose faces lie on one side only. Together 1.5 in this norm.
  EXPECT_GT(std::log2(coarse / fine), 1.5);
}

TEST(ContactPatch, ANodeBelongsToTheCellWithTheNearestCentre) {
  const mesh::Mesh mesh = liner();
  const SurfaceIntegrals s = integrate_surface(mesh.nodes, mesh.surface("y0"));
  const PatchCoupling patches = contact_patches("p", mesh.nodes, s, whole_circle(7, 5), "test");
  const Eigen::MatrixXd& centre = patches.coupling.set.position;
  for (size_t p = 0; p < patches.coupling.rows.size(); ++p) {
    for (const int32_t dof : patches.coupling.rows[p].dofs) {
      const Eigen::RowVector3d x = mesh.nodes.row(dof / 3);
      const Eigen::VectorXd distance = (centre.rowwise() - x).rowwise().norm();
      // A node half way between two centres may go to either.
      EXPECT_LT(distance(static_cast<Eigen::Index>(p)), distance.minCoeff() + 1e-9);
    }
  }
}

TEST(ContactPatch, APatchWithoutNodesIsRefusedAndNamed) {
  try {
    build(liner(12, 2), liner_contact(12, 4));
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("caught no node"), std::string::npos) << text;
    EXPECT_NE(text.find("contact liner"), std::string::npos) << text;
  }
}

TEST(ContactPatch, ASurfaceThatIsNoCylinderIsRefused) {
  const mesh::Mesh mesh = block_mesh({4, 4, 4}, brick({0.1, 0.1, 0.1}));
  const SurfaceIntegrals s = integrate_surface(mesh.nodes, mesh.surface("y0"));
  test::expect_parts(
      test::refusal_of([&] { contact_patches("p", mesh.nodes, s, whole_circle(4, 2), "test"); }),
      {"test: found a node", "m from the axis, expected a cylinder about it (mean radius"});
}

}  // namespace
}  // namespace clatter::assembly::testing
