// SPDX-License-Identifier: GPL-3.0-or-later
// Several solids in one CAD file: each is complete in the mesh, whatever OpenCASCADE integrates.
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>

#include "core/base/error.hpp"
#include "mesh/part/solid_volumes.hpp"
#include "mesh_toml.hpp"
#include "support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using std::numbers::pi;
using testing::Folder;
using testing::mesh_toml;
using testing::Meshed;
namespace occ = gmsh::model::occ;

// A disk with a wavy spline as its rim: r = 25 + 1.5 cos(12 a), mm.
void add_wavy_disk() {
  constexpr int kWaves = 12, kPoints = 6 * kWaves;
  std::vector<int> points;
  for (int i = 0; i < kPoints; ++i) {
    const double a = 2 * pi * i / kPoints, r = 25 + 1.5 * std::cos(kWaves * a);
    points.push_back(occ::addPoint(r * std::cos(a), r * std::sin(a), 0));
  }
  points.push_back(points.front());
  gmsh::vectorpair out;
  occ::extrude({{2, occ::addPlaneSurface({occ::addCurveLoop({occ::addSpline(points)})})}}, 0, 0, 10,
               out);
}

// That disk on a plate of 80 x 80 x 5 mm, and a nut with a hexagonal head's six sides on it.
// Joined, the plate's upper face gets the spline, and OpenCASCADE's integral over the plate, whose
// volume is 32 000 mm3 exactly, changes by 3.6e-5.
void write_assembly(const std::filesystem::path& path) {
  GmshSession session("assembly");
  add_wavy_disk();
  session.box({-40, -40, 10}, {40, 40, 15});
  std::vector<Eigen::Vector3d> hexagon;
  for (int i = 0; i < 6; ++i)
    hexagon.emplace_back(30 + 5 * std::cos(pi * i / 3), 30 + 5 * std::sin(pi * i / 3), 15);
  const Solid nut = session.prism(hexagon, {0, 0, 6});
  session.cut({nut}, {session.cylinder({30, 30, 14}, {0, 0, 8}, 2.5)});
  session.write_cad(path, "mm");
}

TEST(Assembly, HardG5_AVolumeThatChangesOnlyInOpenCascadesIntegralIsCheckedByTheMesh) {
  const Folder folder;
  write_assembly(folder / "assembly.step");
  {
    GmshSession session("moved");  // the preconditions of the case
    const Solids solids = session.import_cad(folder / "assembly.step", "mm");
    ASSERT_EQ(solids.size(), 3u);
    test::expect_parts(
        test::refusal_of<NumericsError>([&] { session.fragment(solids); }),
        {"boolean fragment: found volume ", "the geometry kernel lost or doubled a piece"});
  }
  const Meshed m = mesh_toml(
      "name = 'a'\nkind = 'cad'\n[cad]\nsource = '" + (folder / "assembly.step").string() +
      "'\n[mesh]\nelement_size_mm = 15\nmin_dihedral_deg = 0\nrefine_passes = 1\n");
  ASSERT_EQ(m.part.mesh.regions.size(), 3u);
  double plate = 0.0, nut = 0.0;
  for (const std::string& region : m.part.mesh.regions) {
    const double volume = m.volume(region);
    if (volume > 30e-6) plate = volume;
    if (volume < 1e-6) nut = volume;
  }
  EXPECT_NEAR(plate / 32e-6, 1.0, 1e-9);  // plane faces: rounding, the spline lies in a plane
  const double exact = (1.5 * std::sqrt(3.0) * 25 - pi * 6.25) * 6e-9;
  EXPECT_NEAR(nut / exact, 1.0, 1e-2);  // a coarse round hole
}

PartGeometry one_solid(double as_read, double joined) {
  PartGeometry part{{{"solid", {1}}}, {}};
  part.cad_solids = {{"Nut M8", 7, 18, {30, 10, 5}, as_read, joined, {1}}};
  return part;
}

TEST(Assembly, HardG5_ASolidThatLostAPartIsNamedWithItsVolumesAndTheRemedy) {
  const Mesh mesh = mesh_toml(
                        "name = 'b'\nkind = 'box'\n[box]\nsize = [60, 20, 10]\n[mesh]\n"
                        "element_size_mm = 12\n")
                        .part.mesh;  // 12 000 mm3, no chords
  EXPECT_NO_THROW(check_solid_volumes(one_solid(12000, 12000), mesh, 1e-3, "a.toml"));
  EXPECT_NO_THROW(check_solid_volumes(one_solid(12000, 12000.1), mesh, 1e-3, "a.toml"));
  try {
    check_solid_volumes(one_solid(12000.1, 12000), mesh, 1e-3, "a.toml");
    ADD_FAILURE();
  } catch (const NumericsError& error) {
    for (const char* text :
         {"a.toml: solid 'Nut M8', 7 of 18 at (30, 10, 5) mm", "12000.1 mm3 as read",
          "12000 mm3 after joining", "by its mesh 12000 mm3", "cad.volume_tolerance (now 1e-06",
          "CAD program"})
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << text << "\n"
                                                                         << error.what();
  }
  PartGeometry lenient = one_solid(12000.1, 12000);
  lenient.volume_tolerance = 1e-4;
  EXPECT_NO_THROW(check_solid_volumes(lenient, mesh, 1e-3, "a.toml"));
  lenient.cad_solids[0].name.clear();
  lenient.volume_tolerance = 1e-7;
  test::expect_parts(
      test::refusal_of<NumericsError>([&] { check_solid_volumes(lenient, mesh, 1e-3, "a.toml"); }),
      {"a.toml: solid 7 of 18 at (30, 10, 5) mm", "cad.volume_tolerance (now 1e-07"});
}

// A cylinder: the mesh differs by its chords, which is not a lost part.
TEST(Assembly, HardG5_ChordsExplainWhatARoundSolidLacks) {
  const Meshed tube = mesh_toml(
      "name = 't'\nkind = 'cylinder'\n[cylinder]\nradius = 20\nlength = 30\n[mesh]\n"
      "element_size_mm = 15\n");
  const double exact = pi * 400 * 30, found = 1e9 * tube.volume("solid");
  ASSERT_GT(std::abs(found - exact), 1e-5 * exact);  // coarse: chords matter
  EXPECT_NO_THROW(check_solid_volumes(one_solid(exact, 1.0001 * exact), tube.part.mesh, 1e-3, "t"));
  test::expect_parts(
      test::refusal_of<NumericsError>(
          [&] { check_solid_volumes(one_solid(1.5 * exact, exact), tube.part.mesh, 1e-3, "t"); }),
      {"t: solid 'Nut M8', 7 of 18", "where chords explain", "a part was lost or doubled"});
}

TEST(Assembly, NamesOfSolidsAreReadFromTheFile) {
  const Folder folder;
  write_assembly(folder / "assembly.step");
  std::ifstream file(folder / "assembly.step");
  std::stringstream stream;
  stream << file.rdbuf();
  std::string text = stream.str();
  // The first part's name, as OpenCASCADE's writer of any version gives it.
  const std::regex given("'Open CASCADE STEP translator [0-9.]+ 1\\.1'");
  ASSERT_TRUE(std::regex_search(text, given));
  std::ofstream(folder / "named.step") << std::regex_replace(text, given, "'Gear 12'");
  GmshSession session("names");
  std::string names;
  for (const Solid s : session.import_cad(folder / "named.step", "mm"))
    names += session.name_of(s) + ";";
  EXPECT_EQ(names, "Gear 12;;;");
}

}  // namespace
}  // namespace clatter::mesh
