// SPDX-License-Identifier: GPL-3.0-or-later
// Decks of public projects (shared/data/SOURCES.md). Counts, volumes and positions were computed
// from the files with NumPy, independently of this reader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/mesh/boundary.hpp"
#include "tests/mesh/deck/nastran_support.hpp"
#include "tests/shared_data.hpp"

namespace clatter::test {
namespace {

using Eigen::Vector3d;
using mesh::CellType;
using mesh::deck::Deck;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

// A volume from a few hundred cells of coordinates with 6 to 16 digits.
constexpr double kVolumeTolerance = 1e-9;

class NastranSharedDecks : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(shared_data("nastran"))) GTEST_SKIP() << "no shared/data/nastran";
  }
  Deck read(const std::string& name, const std::vector<std::string>& ignore = {}) const {
    return mesh::deck::read_nastran(shared_data("nastran") / name, {ignore});
  }
};

int64_t count(const Deck& deck, CellType type, const std::string& region) {
  int64_t n = 0;
  for (const auto& block : deck.mesh.cells) {
    if (block.type == type && deck.mesh.regions[static_cast<size_t>(block.region)] == region) {
      n += block.nodes.rows();
    }
  }
  return n;
}

double mass(const Deck& deck, const std::string& region) {
  const auto& names = deck.mesh.regions;
  const auto at = std::find(names.begin(), names.end(), region) - names.begin();
  return mesh::cell_volume(deck.mesh, static_cast<int32_t>(at)) *
         deck.materials.at(deck.regions[static_cast<size_t>(at)].material).density;
}

Vector3d node(const Deck& deck, int32_t id) {
  const auto& ids = deck.mesh.node_ids;
  return deck.mesh.nodes.row(std::find(ids.begin(), ids.end(), id) - ids.begin()).transpose();
}

TEST_F(NastranSharedDecks, SolidBendingIsABlockOfLinearTetrahedra) {
  const Deck deck = read("solid_bending.bdf");
  EXPECT_EQ(deck.mesh.nodes.rows(), 72);
  EXPECT_EQ(count(deck, CellType::kTet4, "pid_1"), 186);
  EXPECT_NEAR(mass(deck, "pid_1"), 6.0, kVolumeTolerance);  // 1 x 2 x 3, density 1
  EXPECT_EQ(node(deck, 6), Vector3d(.473466, .462498, 2.52883));
  EXPECT_THAT(deck.materials.at("mat_1").constants, ElementsAre(3e7, 0.3));
  // SPCADD 2 of SPC1 1 (all of 13 grids) and 3 (rotations of all): restricted to solids.
  ASSERT_THAT(deck.supports, SizeIs(1));
  EXPECT_THAT(deck.supports[0].node_indices, SizeIs(13));
  ASSERT_THAT(deck.steps, SizeIs(1));
  double force = 0.0;
  for (const auto& load : deck.steps[0].forces) force += load.value;
  EXPECT_EQ(force, 23000.0);  // 23 FORCE cards of 1000 along x
}

TEST_F(NastranSharedDecks, SatelliteHasSolidsInTurnedSystems) {
  const Deck deck = read("ISat_Dploy_Sm.dat", {"CQUAD4", "CTRIA3", "CBAR", "CBUSH", "PSHELL",
                                               "PBARL", "PBUSH", "MAT8", "USET", "SUPORT"});
  EXPECT_EQ(deck.mesh.nodes.rows(), 192);
  EXPECT_THAT(deck.mesh.regions, ElementsAre("pid_5", "pid_8", "pid_11", "pid_20"));
  EXPECT_EQ(count(deck, CellType::kHex8, "pid_5"), 10);
  EXPECT_EQ(count(deck, CellType::kHex8, "pid_8"), 4);
  EXPECT_EQ(count(deck, CellType::kHex8, "pid_11"), 5);
  EXPECT_EQ(count(deck, CellType::kHex8, "pid_20"), 6);
  EXPECT_NEAR(mass(deck, "pid_5"), 0.3301578, kVolumeTolerance);
  EXPECT_NEAR(mass(deck, "pid_8"), 0.08158356675, kVolumeTolerance);
  EXPECT_NEAR(mass(deck, "pid_11"), 0.041699540901982614, kVolumeTolerance);
  EXPECT_NEAR(mass(deck, "pid_20"), 0.16308199166925597, kVolumeTolerance);
  // Coordinates of 16 columns, some of ten digits: systems 6 and 61.
  EXPECT_LT(
      (node(deck, 3541) - Vector3d(12.980077557066931, 15.454951285014047, -17.749999999999996))
          .norm(),
      1e-12);
  EXPECT_LT((node(deck, 5564) - Vector3d(7.5, 130.6, -40.2)).norm(), 1e-12);
  EXPECT_THAT(deck.rigid, SizeIs(43));
  double masses = 0.0;
  for (const auto& mass : deck.masses) masses += mass.mass;
  EXPECT_NEAR(masses, 0.77200001, 1e-9);  // the digits of the cards
  EXPECT_EQ(deck.ignored.at("CQUAD4"), 4580);
}

TEST_F(NastranSharedDecks, ShellsAreNotDroppedSilently) {
  EXPECT_THAT([&] { read("ISat_Dploy_Sm.dat"); },
              testing::ThrowsMessage<InputError>(
                  HasSubstr("ISat_Dploy_Sm.dat:87: card USET is not supported")));
}

const std::vector<std::string> kContact = {"BCSET",  "BCTSET", "BCTPARA", "BCRPARA",
                                           "BSURFS", "MATT1",  "TABLEM1"};

TEST_F(NastranSharedDecks, FiveCubesOfAllKindsOfCells) {
  const Deck deck = read("contact_model1.bdf", kContact);
  EXPECT_EQ(count(deck, CellType::kHex8, "pid_1"), 64);
  EXPECT_EQ(count(deck, CellType::kHex20, "pid_3"), 64);
  EXPECT_EQ(count(deck, CellType::kPyramid5, "pid_2"), 16);
  EXPECT_EQ(count(deck, CellType::kTet4, "pid_2"), 436);
  EXPECT_EQ(count(deck, CellType::kPyramid13, "pid_5"), 16);
  EXPECT_EQ(count(deck, CellType::kTet10, "pid_5"), 443);
  EXPECT_EQ(count(deck, CellType::kTet10, "pid_4"), 447);     // 36 of them lack a mid-side node
  EXPECT_EQ(count(deck, CellType::kPyramid13, "pid_4"), 16);  // without those of their bases
  // Cubes of 100 mm and 7.829e-6 kg/mm3; coordinates have eleven digits.
  for (const char* region : {"pid_1", "pid_2", "pid_3", "pid_4", "pid_5"}) {
    EXPECT_NEAR(mass(deck, region), 7.829, kVolumeTolerance) << region;
  }
  // The bases cover a face of their cube with 4 x 4 squares: 2 x 4 x 5 edges.
  EXPECT_THAT(deck.mesh.node_sets.at(mesh::kHangingMidSideNodes), SizeIs(40));
  EXPECT_EQ(deck.mesh.nodes.rows(), 2363 + 40);
  EXPECT_EQ(deck.materials.at("mat_1").reference_temperature, 20.0);  // TEMP(INIT)
  // Pressure 1.65 10^5 on 46 triangles: one side of a cube.
  ASSERT_THAT(deck.steps, SizeIs(1));
  ASSERT_THAT(deck.steps[0].pressures, SizeIs(1));
  EXPECT_EQ(deck.mesh.surface("pload4_2").face_count(), 46);
  EXPECT_NEAR(mesh::integrate(deck.mesh, deck.mesh.surface("pload4_2")).area, 1e4, 1e-6);
}

TEST_F(NastranSharedDecks, AnIncludeTreeOfTwentyEightFilesIsRead) {
  for (const char* job : {"satellite_V02_ACA_QS_SOL101.dat", "relative_path.bdf"}) {
    const Deck deck = read(std::string("models/Satellite_V02/JOBS/QS/") + job,
                           {"CQUAD4", "CBAR", "PSHELL", "PBARL"});
    EXPECT_THAT(deck.files, SizeIs(28));
    EXPECT_EQ(deck.mesh.cell_count(), 0);
    EXPECT_EQ(deck.ignored.at("CQUAD4"), 1392);
    EXPECT_EQ(deck.ignored.at("CBAR"), 102);
    ASSERT_THAT(deck.rigid, SizeIs(1));
    EXPECT_THAT(deck.rigid[0].dependents, SizeIs(6));
    EXPECT_THAT(deck.masses, SizeIs(16));
    ASSERT_THAT(deck.steps, SizeIs(6));
    // LOAD 57: 2 GRAV 1 + 2 GRAV 3 - 10 GRAV 4, each 386.4.
    EXPECT_LT((deck.steps[0].acceleration - Vector3d(772.8, 772.8, -3864)).norm(), 1e-9);
  }
}

TEST_F(NastranSharedDecks, LogicalFileNamesThatNobodyDefinedAreNamed) {
  EXPECT_THAT([&] { read("models/Satellite_V02/JOBS/QS/environment_vars.bdf", {"PSHELL"}); },
              testing::ThrowsMessage<InputError>(HasSubstr("environment_vars.bdf:95: INCLUDE")));
}

}  // namespace
}  // namespace clatter::test
