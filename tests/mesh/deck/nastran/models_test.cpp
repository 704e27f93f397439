// SPDX-License-Identifier: GPL-3.0-or-later
// Complete models: their counts, masses and positions follow from what the tests wrote.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>

#include "core/mesh/boundary.hpp"
#include "tests/assembly/block_mesh.hpp"
#include "tests/mesh/deck/deck_text.hpp"
#include "tests/mesh/deck/nastran/support.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using mesh::CellType;
using mesh::deck::Deck;
using testing::ElementsAre;
using testing::SizeIs;

constexpr double kExact = 1e-13;  // of a volume: rounding of some hundred cells

mesh::Mesh block(const std::array<int, 3>& n, const Vector3d& size, CellType type) {
  assembly::testing::BlockOptions options;
  options.type = type;
  return assembly::testing::block_mesh(n, assembly::testing::brick(size), options);
}

/// Nastran's real numbers have a point.
std::string real(double value) {
  const std::string text = fmt::format("{:.12g}", value);
  return text.find('.') == std::string::npos ? text + "." : text;
}

/// A card in free format, continued after eight fields.
std::string card(const std::string& name, const std::vector<std::string>& fields) {
  std::string text = name;
  for (size_t i = 0; i < fields.size(); ++i) {
    if (i > 0 && i % 8 == 0) text += ",+\n+";
    text += "," + fields[i];
  }
  return text + "\n";
}

/// Bulk data of blocks. A node has the number of its row plus that of its block's first node.
struct Bulk {
  std::string text;
  int next_node = 1, next_cell = 1;

  /// Nodes of a block that is moved along x, and its cells; those whose mid-side nodes are in
  /// `omitted` leave these fields blank.
  int add(const mesh::Mesh& mesh, int property, double x, const std::set<int32_t>& omitted = {}) {
    const int first = next_node;
    for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a, ++next_node)
      if (!omitted.contains(static_cast<int32_t>(a)))
        text += card("GRID", {fmt::format("{}", next_node), "", real(mesh.nodes(a, 0) + x),
                              real(mesh.nodes(a, 1)), real(mesh.nodes(a, 2))});
    add_cells(mesh, property, first, omitted);
    return first;
  }

  void add_cells(const mesh::Mesh& mesh, int property, int first,
                 const std::set<int32_t>& omitted = {}) {
    const std::map<int, std::string> names = {{4, "CTETRA"}, {5, "CPYRAM"}, {8, "CHEXA"}};
    const std::string& name = names.at(mesh::traits(mesh.cells[0].type).corners);
    for (const std::vector<int32_t>& cell : listed_cells(mesh)) {
      std::vector<std::string> fields = {fmt::format("{}", next_cell++),
                                         fmt::format("{}", property)};
      for (const int32_t row : cell)
        fields.push_back(omitted.contains(row) ? "" : fmt::format("{}", row + first));
      text += card(name, fields);
    }
  }
};

int64_t count(const Deck& deck, CellType type, const std::string& region) {
  int64_t n = 0;
  for (const auto& cells : deck.mesh.cells)
    if (cells.type == type && deck.mesh.regions[cells.region] == region) n += cells.nodes.rows();
  return n;
}

double mass(const Deck& deck, const std::string& region) {
  const auto& names = deck.mesh.regions;
  const auto at = std::find(names.begin(), names.end(), region) - names.begin();
  return mesh::cell_volume(deck.mesh, static_cast<int32_t>(at)) *
         deck.materials.at(deck.regions[at].material).density;
}

Vector3d node(const Deck& deck, int32_t id) {
  const auto& ids = deck.mesh.node_ids;
  return deck.mesh.nodes.row(std::find(ids.begin(), ids.end(), id) - ids.begin()).transpose();
}

TEST(NastranModel, ABlockOfLinearTetrahedraIsHeldAndPulled) {
  const mesh::Mesh mesh = block({2, 2, 3}, {1.0, 2.0, 3.0}, CellType::kTet4);
  Bulk bulk;
  bulk.add(mesh, 1, 0.0);
  std::string text = "SOL 101\nCEND\nSPC = 2\nLOAD = 4\nBEGIN BULK\n" + bulk.text +
                     "PSOLID,1,1\nMAT1,1,3.+7,,.3,1.\nSPCADD,2,1,3\n" +
                     fmt::format("SPC1,3,456,1,THRU,{}\n", mesh.nodes.rows());
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) {
    if (mesh.nodes(a, 2) == 0.0) text += fmt::format("SPC1,1,123456,{}\n", a + 1);
    if (mesh.nodes(a, 2) == 3.0) text += fmt::format("FORCE,4,{},,1000.,1.,0.,0.\n", a + 1);
  }
  const Deck deck = read_deck(text + "ENDDATA\n");
  EXPECT_EQ(deck.mesh.nodes, mesh.nodes);
  EXPECT_EQ(count(deck, CellType::kTet4, "pid_1"), 6 * 2 * 2 * 3);
  EXPECT_NEAR(mass(deck, "pid_1"), 6.0, kExact);
  EXPECT_THAT(deck.materials.at("mat_1").constants, ElementsAre(3e7, 0.3));
  ASSERT_THAT(deck.supports, SizeIs(1));  // solids have no rotations
  EXPECT_THAT(deck.supports[0].node_indices, SizeIs(9));
  ASSERT_THAT(deck.steps, SizeIs(1));
  double force = 0.0;
  for (const auto& load : deck.steps[0].forces) force += load.value;
  EXPECT_EQ(force, 9000.0);
}

/// System 6 has its axes along y, z, x of the basic one; 61 lies in it, turned by 30 degrees.
const std::string kSystems =
    "CORD2R,61,6,10.,0.,-5.,10.,0.,-4.,+\n+,10.866025403784439,.5,-5.\n"
    "CORD2R,6,0,1.,2.,3.,2.,2.,3.,+\n+,1.,3.,3.\n";

/// Position of x of system 61 in the basic one, by hand.
Vector3d of_system_61(const Vector3d& x) {
  Matrix3d cycle;
  cycle << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // columns: y, z, x
  const Matrix3d turn =
      Eigen::AngleAxisd(std::numbers::pi / 6.0, Vector3d::UnitZ()).toRotationMatrix();
  return Vector3d(1, 2, 3) + cycle * (Vector3d(10, 0, -5) + turn * x);
}

/// Four blocks of hexahedra in turned systems, on rigid bodies with masses, between shells and
/// bars. Two lines for each number of 16 columns.
std::string satellite(const mesh::Mesh& mesh) {
  const auto nodes = static_cast<int>(mesh.nodes.rows());
  std::string text = kSystems;
  Bulk bulk;
  int number = 0;
  for (const int property : {5, 8, 11, 20}) {
    const int first = 1000 * ++number, reference = first + 900;
    for (int a = 0; a < nodes; ++a)
      text += fmt::format("GRID*   {:16}{:16}{:>16.10f}{:>16.10f}\n*       {:>16.10f}\n", first + a,
                          61, mesh.nodes(a, 0) + 20.0 * number, mesh.nodes(a, 1), mesh.nodes(a, 2));
    bulk.add_cells(mesh, property, first);
    text += fmt::format("PSOLID,{0},{0}\nMAT1,{0},7.+10,,.3,{1}\n", property, real(0.25 * number));
    text += fmt::format("GRID,{},6,{},0.,0.\n", reference, real(number));
    text += fmt::format("RBE2,{},{},123456,{},THRU,{}\n", 100 + number, reference, first,
                        first + nodes - 1);
    text += fmt::format("CONM2*  {:16}{:16}{:16}{:>16.8f}\n*       {:>16.8f}\n", 200 + number,
                        reference, 6, 0.1 * number, 0.5);
    text += fmt::format("CQUAD4,{},300,{},{},{},{}\nCBAR,{},400,{},{},0.,0.,1.\n", 300 + number,
                        first, first + 1, first + 2, first + 3, 400 + number, first, first + 1);
  }
  return text + bulk.text + "PSHELL,300,5,.1\nPBARL,400,5,,ROD,+\n+,.1\nENDDATA\n";
}

TEST(NastranModel, SolidsInTurnedSystemsKeepTheirMassAndPosition) {
  const mesh::Mesh mesh = block({1, 2, 2}, {3.0, 4.0, 5.0}, CellType::kHex8);
  const Deck deck = read_deck(satellite(mesh), {"CQUAD4", "CBAR", "PSHELL", "PBARL"});
  EXPECT_EQ(deck.mesh.nodes.rows(), 4 * mesh.nodes.rows());
  EXPECT_THAT(deck.mesh.regions, ElementsAre("pid_5", "pid_8", "pid_11", "pid_20"));
  for (size_t r = 0; r < 4; ++r) {
    EXPECT_EQ(count(deck, CellType::kHex8, deck.mesh.regions[r]), 4);
    EXPECT_NEAR(mass(deck, deck.mesh.regions[r]), 60.0 * 0.25 * static_cast<double>(r + 1), 1e-11);
  }
  for (const int block_number : {1, 4})
    for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) {
      const Vector3d local = mesh.nodes.row(a).transpose() + Vector3d(20.0 * block_number, 0, 0);
      EXPECT_LT(
          (node(deck, 1000 * block_number + static_cast<int>(a)) - of_system_61(local)).norm(),
          1e-13);  // rounding at 100
    }
  ASSERT_THAT(deck.rigid, SizeIs(4));
  EXPECT_THAT(deck.rigid[2].dependents, SizeIs(mesh.nodes.rows()));
  ASSERT_THAT(deck.masses, SizeIs(4));
  double masses = 0.0;
  for (const auto& one : deck.masses) masses += one.mass;
  EXPECT_NEAR(masses, 1.0, kExact);
  EXPECT_EQ(deck.masses[1].offset, Vector3d(0, 0.5, 0));        // along x of system 6
  EXPECT_EQ(deck.mesh.surfaces.at("pid_300").face_count(), 4);  // they lie on the solids
}

TEST(NastranModel, ShellsAreNotDroppedSilently) {
  const mesh::Mesh mesh = block({1, 2, 2}, {3.0, 4.0, 5.0}, CellType::kHex8);
  const Deck deck = read_deck(satellite(mesh), {"CBAR"});
  EXPECT_EQ(deck.mesh.surface("pid_300").face_count(), 4);
  EXPECT_THAT(
      deck.notes,
      testing::Contains(testing::HasSubstr("4 CQUAD4: faces of solids, now the surface pid_300")));
  EXPECT_THAT(deck.notes, testing::Contains(testing::HasSubstr(
                              "PSHELL 300 gives stiffness to faces of solids, 0.1 thick")));
}

TEST(NastranModel, CubesOfAllKindsOfCells) {
  const double kSide = 10.0, kDensity = 7.8e-6;
  const Vector3d cube = Vector3d::Constant(kSide);
  const auto of = [&](CellType type) { return block({2, 2, 2}, cube, type); };
  Bulk bulk;
  bulk.add(of(CellType::kHex8), 1, 0.0);
  bulk.add(of(CellType::kPyramid5), 2, 20.0);
  bulk.add(of(CellType::kHex20), 3, 40.0);
  bulk.add(of(CellType::kPyramid13), 5, 80.0);
  // The pyramids of this one have no mid-side nodes on its lower side, as next to linear cells.
  const mesh::Mesh partly = of(CellType::kPyramid13);
  std::set<int32_t> omitted;
  for (Eigen::Index c = 0; c < partly.cells[0].nodes.rows(); ++c)
    for (int i = 5; i < 13; ++i)
      if (partly.nodes(partly.cells[0].nodes(c, i), 2) == 0.0)
        omitted.insert(partly.cells[0].nodes(c, i));
  bulk.add(partly, 4, 60.0, omitted);
  const mesh::Mesh pressed = of(CellType::kTet10);
  const int cell = bulk.next_cell, first = bulk.add(pressed, 6, 100.0);
  std::string text = "SOL 101\nCEND\nTEMP(INIT) = 9\nLOAD = 2\nBEGIN BULK\n" + bulk.text;
  for (int p = 1; p <= 6; ++p) text += fmt::format("PSOLID,{},1\n", p);
  text += "MAT1,1,2.1+5,,.3," + real(kDensity * 1e6) + "-6\nTEMPD,9,20.\n";
  int faces = 0;
  for (Eigen::Index c = 0; c < pressed.cells[0].nodes.rows(); ++c) {  // on its upper side
    int on = -1, off = -1, corners = 0;
    for (int i = 0; i < 4; ++i) {
      const int32_t row = pressed.cells[0].nodes(c, i);
      const bool above = pressed.nodes(row, 2) == kSide;
      (above ? on : off) = first + row;
      corners += above ? 1 : 0;
    }
    if (corners != 3) continue;
    text += fmt::format("PLOAD4,2,{},1.65,,,,{},{}\n", cell + c, on, off);
    ++faces;
  }
  const Deck deck = read_deck(text + "ENDDATA\n");
  EXPECT_EQ(count(deck, CellType::kHex8, "pid_1"), 8);
  EXPECT_EQ(count(deck, CellType::kPyramid5, "pid_2"), 48);
  EXPECT_EQ(count(deck, CellType::kHex20, "pid_3"), 8);
  EXPECT_EQ(count(deck, CellType::kPyramid13, "pid_4"), 48);
  EXPECT_EQ(count(deck, CellType::kPyramid13, "pid_5"), 48);
  EXPECT_EQ(count(deck, CellType::kTet10, "pid_6"), 48);
  for (const std::string& region : deck.mesh.regions)
    EXPECT_NEAR(mass(deck, region) / 7.8e-3, 1.0, kExact) << region;
  // 2 x 2 squares have 2 x 2 x 3 edges; the pyramids stand on them.
  EXPECT_THAT(omitted, SizeIs(12));
  EXPECT_THAT(deck.mesh.node_sets.at(mesh::kHangingMidSideNodes), SizeIs(12));
  for (const int32_t row : deck.mesh.node_sets.at(mesh::kHangingMidSideNodes))
    EXPECT_EQ(deck.mesh.nodes(row, 2), 0.0);
  EXPECT_EQ(deck.mesh.nodes.rows(), bulk.next_node - 1);
  EXPECT_EQ(deck.materials.at("mat_1").reference_temperature, 20.0);
  ASSERT_THAT(deck.steps, SizeIs(1));
  ASSERT_THAT(deck.steps[0].pressures, SizeIs(1));
  EXPECT_EQ(deck.steps[0].pressures[0].value, 1.65);
  EXPECT_EQ(faces, 8);
  EXPECT_EQ(deck.mesh.surface("pload4_2").face_count(), faces);
  EXPECT_NEAR(mesh::integrate(deck.mesh, deck.mesh.surface("pload4_2")).area, kSide * kSide, 1e-11);
}

/// A model in a tree of files: jobs beside folders of bulk data, which include further files.
class NastranTree : public testing::Test {
 protected:
  static constexpr int kPanels = 16, kShells = 5, kBars = 3;

  void SetUp() override {
    folder_ = test::scratch_path("tree");
    std::filesystem::remove_all(folder_);
    write("bulk/materials.blk",
          "MAT1,1,7.+10,,.3,2700.\nPSHELL,1,1,.001\nPBARL,2,1,,ROD,+\n+,.01\n");
    write("bulk/rigid/rbe2.blk", "GRID,900,,0.,0.,0.\nRBE2,950,900,123456,1,THRU,6\n");
    std::string grids, masses, panels;
    for (int i = 1; i <= kPanels; ++i) {
      grids += fmt::format("GRID,{},,{}.,0.,0.\n", i, i);
      masses += fmt::format("CONM2,{},{},,.5\n", 800 + i, i);
      panels += fmt::format("INCLUDE 'panel_{}.blk'\n", i);
      std::string shells;
      for (int s = 0; s < kShells; ++s)
        shells += fmt::format("CQUAD4,{},1,1,2,3,4\n", 1000 + 10 * i + s);
      for (int b = 0; b < kBars; ++b)
        shells += fmt::format("CBAR,{},2,1,2,0.,0.,1.\n", 2000 + 10 * i + b);
      write(fmt::format("bulk/panels/panel_{}.blk", i), shells);
    }
    write("bulk/grids.blk", grids);
    write("bulk/masses/conm2.blk", masses);
    write("bulk/panels/all.blk", panels);
    std::string loads = "GRAV,1,,386.4,1.,0.,0.\nGRAV,3,,386.4,0.,1.,0.\nGRAV,4,,386.4,0.,0.,1.\n";
    for (int i = 1; i <= 6; ++i) loads += fmt::format("LOAD,{},1.,2.,1,2.,3,-{}.,4\n", 50 + i, i);
    write("jobs/static/loads.blk", loads);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  Deck read(const std::string& name) const {
    return mesh::deck::read_nastran(folder_ / name, {{"CQUAD4", "CBAR", "PSHELL", "PBARL"}});
  }
  static std::string job(const std::string& bulk, const std::string& slash) {
    std::string text = "SOL 101\nCEND\n";
    for (int i = 1; i <= 6; ++i) text += fmt::format("SUBCASE {}\nLOAD = {}\n", i, 50 + i);
    text += "BEGIN BULK\n";
    for (const char* name : {"materials.blk", "grids.blk"})
      text += fmt::format("INCLUDE '{}{}{}'\n", bulk, slash, name);
    for (const char* folder : {"rigid/rbe2", "masses/conm2", "panels/all"}) {
      std::string path = folder;
      path.replace(path.find('/'), 1, slash);
      text += fmt::format("INCLUDE '{}{}{}.blk'\n", bulk, slash, path);
    }
    return text + "INCLUDE 'loads.blk'\nENDDATA\n";
  }

  std::filesystem::path folder_;
};

TEST_F(NastranTree, OfTwentyThreeFilesIsRead) {
  write("jobs/static/unix.dat", job("../../bulk", "/"));
  write("jobs/static/windows.dat", job("..\\..\\bulk", "\\"));
  for (const char* name : {"jobs/static/unix.dat", "jobs/static/windows.dat"}) {
    const Deck deck = read(name);
    EXPECT_THAT(deck.files, SizeIs(7 + kPanels)) << name;
    EXPECT_EQ(deck.mesh.cell_count(), 0);
    EXPECT_EQ(deck.ignored.at("CQUAD4"), kPanels * kShells);
    EXPECT_EQ(deck.ignored.at("CBAR"), kPanels * kBars);
    ASSERT_THAT(deck.rigid, SizeIs(1));
    EXPECT_THAT(deck.rigid[0].dependents, SizeIs(6));
    EXPECT_THAT(deck.masses, SizeIs(kPanels));
    ASSERT_THAT(deck.steps, SizeIs(6));
    EXPECT_LT((deck.steps[4].acceleration - 386.4 * Vector3d(2, 2, -5)).norm(), 1e-12);
  }
}

TEST_F(NastranTree, LogicalFileNamesThatNobodyDefinedAreNamed) {
  write("jobs/static/logical.dat", "SOL 101\nCEND\nBEGIN BULK\nINCLUDE 'MODEL_bulk:grids.blk'\n");
  expect_parts(refusal_of([&] { read("jobs/static/logical.dat"); }),
               {"logical.dat:4: INCLUDE 'MODEL_bulk:grids.blk': found no such file"});
}

}  // namespace
}  // namespace clatter::test
