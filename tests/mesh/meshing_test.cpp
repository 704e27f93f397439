// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases of gmsh and OpenCASCADE (docs/hard-cases.md, section G), on small parts.
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <numeric>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/validity.hpp"
#include "iges_box.hpp"
#include "mesh/part/mesher.hpp"
#include "mesh/repair/unfold.hpp"
#include "mesh_toml.hpp"
#include "support.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using testing::Folder;
using testing::mesh_toml;
using testing::Meshed;

PartGeometry part_of(const Solids& solids) { return {{{"solid", solids}}, {}}; }

MeshSettings coarse(double size_mm, int per_turn) {
  MeshSettings settings;
  settings.element_size = 1e-3 * size_mm;
  settings.elements_per_turn = per_turn;
  return settings;
}

constexpr const char* kBeam =
    "name = 'beam'\nkind = 'box'\n[box]\nsize = [60, 20, 10]\n[mesh]\nelement_size_mm = 12\n";

// A single-cylinder block: every feature of the four-cylinder one, a quarter of the work.
constexpr const char* kOneCylinder =
    "name = 'block'\nkind = 'block'\n[block]\ncylinders = 1\n"
    "[mesh]\nelement_size_mm = 30\nelements_per_turn = 16\n";

TEST(Gmsh, HardG1_AThrownStringBecomesAClatterError) {
  GmshSession session("g1");
  test::expect_parts(test::refusal_of([&] { session.import_cad("/nowhere/part.step", "mm"); }),
                     {"/nowhere/part.step: file not found"});
  test::expect_parts(test::refusal_of<NumericsError>([&] { session.volume({4711}); }),
                     {"volume: ", "4711"});
  const Folder folder;
  std::ofstream(folder / "no.step") << "this is no STEP file\n";
  test::expect_parts(test::refusal_of([&] { session.import_cad(folder / "no.step", "mm"); }),
                     {"no.step: Could not read file"});
}

TEST(Gmsh, OneSessionAtATimeAndTheNextAfterIt) {
  {
    GmshSession session("first");
    test::expect_parts(test::refusal_of<std::logic_error>([&] { GmshSession("second"); }),
                       {"a Gmsh session is already open; Gmsh has one global state"});
  }
  EXPECT_NO_THROW(GmshSession("third"));
}

// Cells with det J <= 0 at any of the points (barycentric).
int64_t count_negative(const Mesh& mesh, const std::vector<Eigen::Vector4d>& points) {
  int64_t count = 0;
  for (Eigen::Index c = 0; c < mesh.cells[0].nodes.rows(); ++c) {
    const Tet10Nodes x = tet_nodes(mesh, mesh.cells[0], c);
    count += std::any_of(points.begin(), points.end(),
                         [&](const Eigen::Vector4d& l) { return testing::det_at(x, l) <= 0.0; });
  }
  return count;
}

// The block of hard case G2: 3.5 mm wall around a bore. With h = 20 as the largest size gmsh 4.8.4
// makes 1126 cells: 6 are folded at their corners, none at the four Gauss points.
TEST(Gmsh, HardG2_FoldedCellsInAThinCurvedWallAreFoundAndRepaired) {
  const auto thin_wall = [](GmshSession& session) {
    return session.cut({session.box({-50, -50, 0}, {50, 50, 150})},
                       {session.cylinder({0, 0, -1}, {0, 0, 152}, 46.5)});
  };
  GmshSession session("g2");
  const PartGeometry part = part_of(thin_wall(session));
  SizeSettings sizes;
  sizes.size = 20.0;
  session.generate(sizes);
  session.make_quadratic();
  const auto as_mesh = [&] {
    const RawMesh raw = session.extract();
    Mesh mesh;
    mesh.nodes = raw.nodes;
    mesh.regions = {"solid"};
    mesh.cells = {{CellType::kTet10, 0, raw.cells.begin()->second, {}}};
    return mesh;
  };
  Mesh mesh = as_mesh();
  const size_t folded = check_validity(mesh).invalid.size();
  std::vector<Eigen::Vector4d> gauss, corners;
  for (int i = 0; i < 4; ++i) {
    corners.push_back(Eigen::Vector4d::Unit(i));
    gauss.push_back(Eigen::Vector4d::Constant(0.13819660) + 0.4472136 * Eigen::Vector4d::Unit(i));
  }
  test::expect_at_least("cells that are folded without repair", static_cast<double>(folded), 4);
  EXPECT_EQ(count_negative(mesh, corners), static_cast<int64_t>(folded));
  EXPECT_EQ(count_negative(mesh, gauss), 0);
  unfold_cells(mesh, 0.1);
  EXPECT_TRUE(check_validity(mesh).invalid.empty());
  session.repair_curved_cells();
  EXPECT_TRUE(check_validity(as_mesh()).invalid.empty());

  const PartMesh whole = mesh_part(session, part, coarse(20, 0), 1e-3, "g2", "g2");
  EXPECT_GT(whole.certificate.min_scaled_jacobian, 0.0);
}

TEST(Gmsh, HardG3_MidSideNodesOfAStraightBoxLieInTheMiddle) {
  const Mesh mesh = mesh_toml(kBeam).part.mesh;
  for (Eigen::Index c = 0; c < mesh.cells[0].nodes.rows(); ++c) {
    const Tet10Nodes x = tet_nodes(mesh, mesh.cells[0], c);
    for (int e = 0; e < 6; ++e) {
      const auto [a, b] = kTetEdges[e];
      // Gmsh keeps about 12 digits of a 60 mm part.
      EXPECT_LT((x.row(4 + e) - 0.5 * (x.row(a) + x.row(b))).norm(), 1e-12);
    }
  }
}

TEST(Gmsh, HardG4_NoSolidIsLostBetweenCadAndMesh) {
  const Meshed m = mesh_toml(kOneCylinder);
  const double liner = pi * (0.0605 * 0.0605 - 0.0535 * 0.0535) * 0.230;
  // Quadratic facets of 22.5 degrees are off by about 1e-4 of a wall's thickness squared.
  EXPECT_NEAR(m.volume("liner") / liner, 1.0, 1e-4);
  EXPECT_NEAR(m.volume("block") + m.volume("liner"), m.part.certificate.cad_volume_m3.value(),
              1e-4 * m.part.certificate.cad_volume_m3.value());
  for (const char* name : {"liner_1_bore", "head_1", "bearing_1", "bearing_2", "mount_1", "mount_4",
                           "pan_flange", "deck", "outer", "skin"}) {
    EXPECT_GT(m.part.mesh.surface(name).face_count(), 0) << name;
  }
  EXPECT_NEAR(integrate(m.part.mesh, m.part.mesh.surface("liner_1_bore")).area, pi * 0.107 * 0.230,
              1e-3 * pi * 0.107 * 0.230);  // facets as above
}

TEST(Gmsh, HardG5_BooleansGiveAnalyticVolumes) {
  GmshSession session("g5");
  const Solid box = session.box({0, 0, 0}, {100, 80, 60});
  const Solid hole = session.cylinder({50, 40, -1}, {0, 0, 62}, 20);
  const Solids plate = session.cut({box}, {hole});
  const double plate_volume = 100.0 * 80 * 60 - pi * 400 * 60;
  test::expect_at_most("error of the volume of a plate",
                       std::abs(session.volume(plate) / plate_volume - 1.0), 1e-6);
  const Solids sleeve = session.cut({session.cylinder({50, 40, 0}, {0, 0, 60}, 20)},
                                    {session.cylinder({50, 40, 0}, {0, 0, 60}, 15)});
  const auto pieces = session.fragment({plate.front(), sleeve.front()});
  EXPECT_NEAR(session.volume(pieces[1]) / (pi * 175 * 60), 1.0, 1e-6);
  const Solids lid = session.fuse(pieces[0], {session.box({0, 0, 55}, {100, 80, 70})});
  EXPECT_NEAR(session.volume(lid) / (plate_volume + 100.0 * 80 * 10 + pi * 400 * 5), 1.0, 1e-6);
}

// The sample's block turned by 17 degrees about its x axis, written as STEP and read again: bores
// and decks are found at their new positions.
TEST(Gmsh, HardG5_FourBoresAndDecksAreFoundAfterARotation) {
  const Folder folder;
  const Vector3d up(0.0, -std::sin(17 * pi / 180), std::cos(17 * pi / 180));
  {
    const Config config = Config::parse("name = 'b'\nkind = 'block'\n[block]\n", "b.toml");
    GmshSession session("turned");
    build_part(session, part_keys().read(config).shape);
    session.rotate(session.all_solids(), Vector3d::Zero(), Vector3d::UnitX(), 17.0);
    session.write_cad(folder / "turned.step", "mm");
  }
  GmshSession session("again");
  session.import_cad(folder / "turned.step", "mm");
  session.fragment(session.all_solids());
  const auto faces = session.boundary_faces();
  for (int i = 0; i < 4; ++i) {
    const double x = (i - 1.5) * 130.0;
    SurfaceFilter bore, deck;
    bore.cylinder = CylinderFilter{53.5, {x, 0, 0}, up};
    deck.plane = PlaneFilter{up, 345.0};
    const Vector3d half(61, 200, 400);
    deck.box = BoxFilter{Vector3d(x, 0, 0) - half, Vector3d(x, 0, 0) + half};
    const double tolerance = 1e-3;  // mm; STEP keeps about 1e-7 relative
    EXPECT_EQ(select_faces(faces, {"bore", {bore}, tolerance}, {}, "t").tags.size(), 1u);
    EXPECT_EQ(select_faces(faces, {"head", {deck}, tolerance}, {}, "t").tags.size(), 1u);
  }
}

TEST(Gmsh, HardG6_UnitsOfAStepFileAreKeptAndGuarded) {
  const Folder folder;
  {
    GmshSession session("g6");
    session.box({0, 0, 0}, {60, 20, 10});
    session.write_cad(folder / "beam.step", "mm");
  }
  const std::string head = "name = 'beam'\nkind = 'cad'\n";
  const std::string source = "[cad]\nsource = '" + (folder / "beam.step").string() + "'\n";
  const std::string size = "[mesh]\nelement_size_mm = 12\n";
  const Meshed in_mm = mesh_toml(head + source + "expected_box = [60, 20, 10]\n" + size);
  const Meshed in_m = mesh_toml(head + "length_unit = 'm'\n" + source +
                                "expected_box = [0.06, 0.02, 0.01]\n" + size);
  EXPECT_NEAR(in_mm.volume("solid"), 12e-6, 1e-17);  // flat faces: rounding only
  EXPECT_NEAR(in_m.volume("solid"), 12e-6, 1e-17);
  test::expect_parts(test::refusal_of([&] {
                       mesh_toml(head + source + "expected_box = [2.36, 0.79, 0.39]\n" + size);
                     }),
                     {"part.toml:",
                      "cad.expected_box: found a part of 60 x 20 x 10 mm, expected 2.36 x 0.79 x "
                      "0.39: is the file in another unit?"});
}

// Gmsh reads IGES and does not write it: the file has six separate bilinear patches, in
// millimetres.
TEST(Gmsh, HardG6_UnitsOfAnIgesFileAreKeptAndGuardedAndItsFacesSewn) {
  const Folder folder;
  std::ofstream(folder / "beam.igs") << testing::iges_box({60, 20, 10});
  const std::string head = "name = 'beam'\nkind = 'cad'\n";
  const std::string source = "[cad]\nsource = '" + (folder / "beam.igs").string() + "'\n";
  const std::string size = "[mesh]\nelement_size_mm = 12\n";
  const Meshed in_mm = mesh_toml(head + source + "expected_box = [60, 20, 10]\n" + size +
                                 "[surface.end]\nplane = { normal = [1, 0, 0], height = 60 }\n");
  test::expect_at_most("error of the volume from IGES",
                       std::abs(in_mm.volume("solid") / 12e-6 - 1.0),
                       1e-9);  // flat faces, sewn within OCC's tolerance
  EXPECT_NEAR(integrate(in_mm.part.mesh, in_mm.part.mesh.surface("end")).area, 2e-4, 1e-12);
  const Meshed in_m = mesh_toml(head + "length_unit = 'm'\n" + source +
                                "expected_box = [0.06, 0.02, 0.01]\n" + size);
  EXPECT_NEAR(in_m.volume("solid") / 12e-6, 1.0, 1e-9);
  test::expect_parts(test::refusal_of([&] {
                       mesh_toml(head + source + "expected_box = [0.06, 0.02, 0.01]\n" + size);
                     }),
                     {"part.toml:",
                      "cad.expected_box: found a part of 60 x 20 x 10 mm, expected 0.06 x 0.02 x "
                      "0.01: is the file in another unit?"});
}

TEST(Gmsh, HardG7_TwoRunsGiveTheSameBits) {
  const std::string tube =
      "name = 'tube'\nkind = 'cylinder'\n[cylinder]\nradius = 20\ninner_radius = 16\nlength = 60\n"
      "[mesh]\nelement_size_mm = 9\nelements_per_turn = 12\n";
  const Mesh first = mesh_toml(tube).part.mesh, second = mesh_toml(tube).part.mesh;
  EXPECT_EQ(first.nodes, second.nodes);
  EXPECT_EQ(first.cells[0].nodes, second.cells[0].nodes);
  test::expect_at_most("difference of two meshes [m]",
                       (first.nodes - second.nodes).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(first.surface("inner").faces[0].nodes, second.surface("inner").faces[0].nodes);
}

TEST(Gmsh, HardG8_SmallestDihedralAngleIsAtLeastEightDegrees) {
  const Meshed block = mesh_toml(kOneCylinder);
  test::expect_at_least("smallest dihedral angle [deg]", block.part.quality.min_dihedral_deg.worst,
                        8.0);
  const Measure& ratio = block.part.quality.radius_ratio;
  EXPECT_EQ(std::accumulate(ratio.histogram.begin(), ratio.histogram.end(), int64_t{0}),
            block.part.mesh.cell_count());
  EXPECT_GT(ratio.worst, 0.02);
  EXPECT_GE(mesh_toml(kBeam).part.quality.min_dihedral_deg.worst, 8.0);
}

TEST(Gmsh, HardG9_SurfaceIntegralGivesTheVolumeAndNormalsPointOut) {
  const auto c = mesh_toml(kOneCylinder).part.certificate;
  test::expect_at_most("volume against surface integral", c.volume_against_surface_integral,
                       1e-12);  // rounding of 1e4 sums
  EXPECT_LT(c.closed_surface_residue, 1e-12);
  EXPECT_EQ(c.inward_normals, 0.0);
}

// gmsh_call.hpp refuses to compile against another major version or one before 4.8; what runs is
// what was compiled against.
TEST(Gmsh, HardG10_LibraryVersionIsThatOfTheHeader) {
  EXPECT_TRUE(GmshSession::library_version().starts_with("4.")) << GmshSession::library_version();
  const GmshSession session("g10");
  EXPECT_TRUE(session.running_version().starts_with(GmshSession::library_version() + "."))
      << session.running_version();
}

TEST(Piston, GasPressureActsOnTheEntireBoreArea) {
  const Meshed m = mesh_toml(
      "name = 'piston'\nkind = 'piston'\n[piston]\npin_offset = 0.5\n"
      "[mesh]\nelement_size_mm = 16\nelements_per_turn = 16\n");
  const SurfaceIntegrals crown = integrate(m.part.mesh, m.part.mesh.surface("crown"));
  const double area = 0.25 * pi * 0.107 * 0.107;
  // Quadratic chords of 22.5 degrees enclose the circle's area to about 1e-5.
  EXPECT_NEAR(crown.normal.z() / area, 1.0, 1e-4);
  EXPECT_NEAR(crown.normal.y() / area, 0.0, 1e-4);
  const SurfaceIntegrals skirt = integrate(m.part.mesh, m.part.mesh.surface("skirt"));
  EXPECT_NEAR(skirt.centre.y(), -0.0005, 1e-5);  // both sides alike about the offset axis
  EXPECT_LT(skirt.centre.z(), 0.036);
  EXPECT_NEAR(integrate(m.part.mesh, m.part.mesh.surface("pin_bore")).normal.norm(), 0.0, 1e-6);
}

TEST(Mesher, LocalSizeRefinesItsSurface) {
  const std::string local = "[[mesh.local]]\nsurface = 'x_min'\nfactor = 0.4\n";
  const Meshed plain = mesh_toml(kBeam), finer = mesh_toml(kBeam + local);
  EXPECT_GT(static_cast<double>(finer.part.mesh.surface("x_min").face_count()),
            1.5 * static_cast<double>(plain.part.mesh.surface("x_min").face_count()));
  test::expect_parts(
      test::refusal_of([&] {
        mesh_toml(kBeam + std::string("[[mesh.local]]\nsurface = 'x_mni'\nfactor = 0.4\n"));
      }),
      {"part.toml: mesh.local: surface 'x_mni' not found, expected one of: ", "x_min"});
}

constexpr const char* kTube =
    "name = 'tube'\nkind = 'cylinder'\n[cylinder]\nradius = 40\ninner_radius = 10\nlength = 40\n"
    "[mesh]\nelement_size_mm = 20\n";

double longest_edge(const Mesh& mesh, const std::string& surface) {
  double longest = 0.0;
  for (const FaceBlock& block : mesh.surface(surface).faces)
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f)
      for (int i = 0; i < 3; ++i)
        longest = std::max(longest, (mesh.nodes.row(block.nodes(f, i)) -
                                     mesh.nodes.row(block.nodes(f, (i + 1) % 3)))
                                        .norm());
  return longest;
}

TEST(Mesher, ElementsPerTurnOnOneSurfaceRefineThatBoreOnly) {
  const Meshed plain = mesh_toml(kTube);
  const Meshed finer =
      mesh_toml(kTube + std::string("[[mesh.local]]\nsurface = 'inner'\nelements_per_turn = 24\n"));
  const double requested = 2.0 * pi * 0.010 / 24.0;
  EXPECT_GT(longest_edge(plain.part.mesh, "inner"), 2.0 * requested);
  // Gmsh's edges are up to about 1.5 times the requested length.
  EXPECT_LT(longest_edge(finer.part.mesh, "inner"), 1.6 * requested);
  EXPECT_GT(longest_edge(finer.part.mesh, "outer"), 4.0 * requested);
}

// Cells whose centre lies within 6 mm of the bore: their mean edge follows size + growth *
// distance.
TEST(Mesher, HardG10_GrowthIsTheRateOfCoarseningAwayFromASurface) {
  const auto count = [](double growth) {
    return mesh_toml(kTube +
                     ("[[mesh.local]]\nsurface = 'inner'\nelements_per_turn = 16\ngrowth = " +
                      std::to_string(growth) + "\n"))
        .part.mesh.cell_count();
  };
  const int64_t slow = count(0.1), fast = count(0.6);
  EXPECT_GT(static_cast<double>(slow), 2.0 * static_cast<double>(fast));
}

TEST(Mesher, ALocalSizeWithoutEffectIsRefused) {
  test::expect_parts(
      test::refusal_of([&] {
        mesh_toml(kBeam + std::string("[[mesh.local]]\nsurface = 'x_min'\ngrowth = 0.2\n"));
      }),
      {"part.toml:", "mesh.local[0].factor: give factor or elements_per_turn"});
}

TEST(Mesher, ImpossibleDimensionsAreRefusedByName) {
  const auto refused = [](const std::string& text, const char* key) {
    try {
      mesh_toml(text);
      ADD_FAILURE() << key;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(key), std::string::npos) << error.what();
    }
  };
  const std::string block = "name = 'b'\nkind = 'block'\n[block]\n";
  refused(block + "cylinder_pitch = 110\n", "cylinder_pitch");
  refused(block + "bearing_wall = 30\n", "bearing_wall");
  refused(block + "jacket_depth = 205\n", "jacket_depth");
  refused("name = 'p'\nkind = 'piston'\n[piston]\nboss_diameter = 80\n", "boss_diameter");
  refused("name = 'p'\nkind = 'gearbox'\n", "kind");
  refused("name = 'p'\nkind = 'box'\n[box]\nsize = [1, 2, -3]\n", "size");
  refused(std::string(kBeam) + "elment_size_mm = 3\n", "elment_size_mm");
}

}  // namespace
}  // namespace clatter::mesh
