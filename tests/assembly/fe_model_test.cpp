// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/fe_model.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "block_mesh.hpp"
#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter::assembly::testing {
namespace {

fe::FeModel sample() {
  return build(block_mesh({2, 1, 1}, brick({0.2, 0.1, 0.1})), R"(
[damping]
alpha = 1e-6
beta = 2.0
[[coupling]]
name = "end"
surface = "x1"
[[load]]
name = "gas"
kind = "pressure"
surface = "z1"
)")
      .model;
}

class FeModelFile : public ::testing::Test {
 protected:
  void SetUp() override { path_ = test::scratch_path("fe.fe.h5"); }
  void TearDown() override { std::filesystem::remove(path_); }
  void save(const fe::FeModel& model) const {
    H5File file = H5File::create(path_);
    write_provenance(file, {fe::kFeSchema, "", {}});
    fe::write_fe_model(file, model);
    file.commit();
  }
  std::string refusal() const {
    try {
      fe::read_fe_model(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  std::filesystem::path path_;
};

TEST_F(FeModelFile, ReturnsWhatWasWritten) {
  const fe::FeModel model = sample();
  save(model);
  const fe::FeModel back = fe::read_fe_model(path_);
  EXPECT_EQ(back.name, model.name);
  EXPECT_EQ((back.K - model.K).norm(), 0.0);
  EXPECT_EQ((back.M - model.M).norm(), 0.0);
  EXPECT_EQ((back.T - model.T).norm(), 0.0);
  EXPECT_EQ((back.rigid - model.rigid).norm(), 0.0);
  EXPECT_EQ(back.alpha, 1e-6);
  EXPECT_EQ(back.beta, 2.0);
  EXPECT_EQ(back.set("end").dofs, model.set("end").dofs);
  EXPECT_EQ(back.loads.at("gas"), model.loads.at("gas"));
  EXPECT_EQ(back.load_units.at("gas"), "Pa");
  EXPECT_EQ(back.surfaces.at("x1").faces[0].nodes, model.surfaces.at("x1").faces[0].nodes);
  EXPECT_EQ(back.mass.mass, model.mass.mass);
  test::expect_parts(test::refusal_of([&] { back.set("edn"); }),
                     {"set: found \"edn\", expected one of: ", "end"});
}

TEST_F(FeModelFile, ReturnsTheCellsAndTheirMaterials) {
  fe::FeModel model = sample();
  fe::Axes axes;
  axes.kind = fe::Axes::Kind::kCylindrical;
  axes.origin << 1.0, 2.0, 3.0;
  axes.frame << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  fe::Material wood{0.0, 0.0, 450.0};
  wood.elasticity = fe::Elasticity::Identity() * 1e10;
  wood.expansion << 1e-6, 2e-6, 3e-6, 4e-6, 5e-6, 6e-6;
  wood.axes = axes;
  wood.integration.hex20 = fe::Integration::kReduced;
  model.cells.materials = {wood};
  for (int32_t a = 0; a < model.nodes.rows(); ++a) model.cells.node_ids.push_back(3 * a + 5);
  model.temperature_rise["gas"] = Eigen::VectorXd::LinSpaced(model.nodes.rows(), 0.0, 9.0);
  save(model);
  const fe::FeModel back = fe::read_fe_model(path_);
  EXPECT_EQ(back.cells.regions, model.cells.regions);
  EXPECT_EQ(back.cells.node_ids, model.cells.node_ids);
  ASSERT_EQ(back.cells.blocks.size(), model.cells.blocks.size());
  EXPECT_EQ(back.cells.blocks[0].type, model.cells.blocks[0].type);
  EXPECT_EQ(back.cells.blocks[0].nodes, model.cells.blocks[0].nodes);
  const fe::Material& read = back.cells.materials.at(0);
  const Eigen::Vector3d position(0.3, 0.1, 0.2);
  EXPECT_EQ(read.elasticity_at(position), wood.elasticity_at(position));
  EXPECT_EQ(read.expansion_at(position), wood.expansion_at(position));
  EXPECT_EQ(read.density, 450.0);
  EXPECT_EQ(read.integration.hex20, fe::Integration::kReduced);
  EXPECT_EQ(read.integration.hex8, fe::Integration::kIncompatible);
  EXPECT_EQ(back.temperature_rise.at("gas"), model.temperature_rise.at("gas"));
}

// Quadrilaterals and triangles of one region have one section with axes and layers.
TEST_F(FeModelFile, ReturnsTheSectionOfARegionOfTwoKindsOfShells) {
  fe::FeModel model = sample();
  mesh::ShellBlock quads, triangles;
  quads.type = mesh::FaceType::kQuad4;
  quads.nodes = IndexMatrix(1, 4);
  quads.nodes << 0, 1, 2, 3;
  triangles.type = mesh::FaceType::kTri3;
  triangles.nodes = IndexMatrix(1, 3);
  triangles.nodes << 1, 2, 3;
  quads.region = triangles.region = 1;
  model.cells.regions.push_back("sheet");
  model.cells.materials.push_back(model.cells.materials.at(0));
  model.cells.shells = {quads, triangles};
  fe::ShellSection section;
  section.thickness = 0.002;
  section.axes =
      fe::Axes{fe::Axes::Kind::kCylindrical, {1.0, 2.0, 3.0}, Eigen::Matrix3d::Identity()};
  section.layers.push_back({model.cells.materials.at(0), 0.002, 0.3});
  model.cells.sections = {fe::ShellSection{}, section};
  save(model);
  const fe::FeModel back = fe::read_fe_model(path_);
  ASSERT_EQ(back.cells.shells.size(), 2u);
  EXPECT_EQ(back.cells.sections.at(1).axes->origin, section.axes->origin);
  EXPECT_EQ(back.cells.sections[1].layers.at(0).angle, 0.3);
}

TEST_F(FeModelFile, RefusesCellsOnNodesThatDoNotExist) {
  fe::FeModel model = sample();
  model.cells.blocks[0].nodes(0, 1) = static_cast<int32_t>(model.nodes.rows());
  save(model);
  EXPECT_NE(refusal().find("node"), std::string::npos) << refusal();
}

TEST_F(FeModelFile, RefusesAMaterialWithoutElasticEnergy) {
  fe::FeModel model = sample();
  model.cells.materials[0].poisson = 0.5;
  save(model);
  EXPECT_NE(refusal().find("materials/0: found E = 2.1e+11, nu = 0.5"), std::string::npos)
      << refusal();
}

TEST_F(FeModelFile, RefusesMatricesOfDifferentSize) {
  fe::FeModel model = sample();
  model.M.conservativeResize(model.M.rows() - 1, model.M.cols() - 1);
  save(model);
  EXPECT_NE(refusal().find(": M: found"), std::string::npos) << refusal();
}

TEST_F(FeModelFile, RefusesADiagonalThatIsNotPositive) {
  fe::FeModel model = sample();
  model.K.coeffRef(7, 7) = -1.0;
  save(model);
  EXPECT_NE(refusal().find("K, column 7: found diagonal -1"), std::string::npos) << refusal();
}

TEST_F(FeModelFile, RefusesNumbersThatAreNotFinite) {
  fe::FeModel model = sample();
  model.rigid(3, 3) = std::nan("");
  save(model);
  EXPECT_NE(refusal().find("rigid"), std::string::npos) << refusal();
}

TEST_F(FeModelFile, RefusesTrianglesBeyondTheNodes) {
  fe::FeModel model = sample();
  model.surfaces.at("x1").faces[0].nodes(0, 0) = 100000;
  save(model);
  EXPECT_NE(refusal().find("surfaces/x1"), std::string::npos) << refusal();
}

TEST_F(FeModelFile, RefusesADofThatDoesNotExist) {
  fe::FeModel model = sample();
  model.sets.at("end").dofs[2] = model.size();
  save(model);
  EXPECT_NE(refusal().find("end"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace clatter::assembly::testing
