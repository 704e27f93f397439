// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh in files: round trips, and what a reader refuses.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/mesh/mesh_file.hpp"
#include "mesh/exports/mesh_export.hpp"
#include "support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using testing::Folder;
using testing::one_cell;
using testing::reference_tet10;

void write_file(const std::filesystem::path& path, const Mesh& mesh) {
  H5File file = H5File::create(path);
  write_mesh(file, mesh);
  write_provenance(file, {kMeshSchema, "", {}});
  file.commit();
}

std::string file_refusal(const std::filesystem::path& path) {
  try {
    read_mesh(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(MeshFile, EverythingSurvivesTheRoundTrip) {
  const Folder folder;
  const Mesh mesh = one_cell();
  write_file(folder / "one.mesh.h5", mesh);
  const Mesh back = read_mesh(folder / "one.mesh.h5");
  EXPECT_EQ(back.name, mesh.name);
  EXPECT_EQ(back.nodes, mesh.nodes);
  EXPECT_EQ(back.regions, mesh.regions);
  ASSERT_EQ(back.cells.size(), 1u);
  EXPECT_EQ(back.cells[0].type, CellType::kTet10);
  EXPECT_EQ(back.cells[0].nodes, mesh.cells[0].nodes);
  EXPECT_EQ(back.surface("skin").faces[0].nodes, mesh.surface("skin").faces[0].nodes);
  EXPECT_EQ(back.node_set("tip"), mesh.node_set("tip"));
}

TEST(MeshFile, TruncatedFileIsRefused) {
  const Folder folder;
  write_file(folder / "one.mesh.h5", one_cell());
  std::filesystem::resize_file(folder / "one.mesh.h5", 900);
  EXPECT_NE(file_refusal(folder / "one.mesh.h5").find("one.mesh.h5"), std::string::npos);
}

TEST(MeshFile, FoldedCellIsRefusedWithItsPosition) {
  const Folder folder;
  Tet10Nodes x = reference_tet10();
  x(4, 0) = 0.2;
  write_file(folder / "folded.mesh.h5", one_cell(x));
  EXPECT_NE(file_refusal(folder / "folded.mesh.h5").find("inverted or folded"), std::string::npos);
}

TEST(MeshFile, InvertedCellIsRefused) {
  const Folder folder;
  Tet10Nodes x = reference_tet10();
  x.col(2) *= -1.0;
  write_file(folder / "inverted.mesh.h5", one_cell(x));
  EXPECT_NE(file_refusal(folder / "inverted.mesh.h5").find("cell 0 of block 0"), std::string::npos);
}

TEST(MeshFile, WrongContentsAreRefusedOneByOne) {
  const Folder folder;
  const auto refused = [&](const char* expected, const auto& spoil) {
    Mesh mesh = one_cell();
    spoil(mesh);
    write_file(folder / "bad.mesh.h5", mesh);
    EXPECT_NE(file_refusal(folder / "bad.mesh.h5").find(expected), std::string::npos)
        << file_refusal(folder / "bad.mesh.h5");
  };
  refused("found node 10, expected 0 to 9", [](Mesh& m) { m.cells[0].nodes(0, 9) = 10; });
  refused("found region 3", [](Mesh& m) { m.cells[0].region = 3; });
  refused("not finite", [](Mesh& m) { m.nodes(2, 1) = std::nan(""); });
  refused("belongs to no cell", [](Mesh& m) {
    m.nodes.conservativeResize(11, 3);
    m.nodes.row(10).setZero();
  });
  refused("found node -1", [](Mesh& m) { m.surfaces["skin"].faces[0].nodes(0, 0) = -1; });
  refused("no surface named skin", [](Mesh& m) {
    m.surfaces["hull"] = m.surfaces["skin"];
    m.surfaces.erase("skin");
  });
}

TEST(Mesh, MissingSurfaceIsAnErrorThatListsTheOthers) {
  try {
    one_cell().surface("crown");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected one of: skin"), std::string::npos);
  }
}

// Abaqus C3D10 (manual, "Three-dimensional solid element library"): nodes 5-10 lie on the edges
// 1-2, 2-3, 3-1, 1-4, 2-4, 3-4.
TEST(MeshExport, HardG3_AbaqusMidSideNodesLieOnAbaqusEdges) {
  const Folder folder;
  const Mesh mesh = one_cell();
  export_mesh(mesh, folder / "one.inp");
  std::ifstream file(folder / "one.inp");
  std::string line;
  while (std::getline(file, line) && line.find("*ELEMENT, TYPE=C3D10, ELSET=steel") != 0) {
  }
  ASSERT_TRUE(std::getline(file, line));
  std::vector<int> ids;
  for (char& c : line) c = c == ',' ? ' ' : c;
  std::istringstream text(line);
  for (int id; text >> id;) ids.push_back(id);
  ASSERT_EQ(ids.size(), 11u);
  const int edges[6][2] = {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}};
  for (int e = 0; e < 6; ++e) {
    const auto at = [&](int k) { return mesh.nodes.row(ids[k] - 1); };
    EXPECT_EQ(at(5 + e), 0.5 * (at(edges[e][0]) + at(edges[e][1]))) << "node " << 5 + e;
  }
}

TEST(MeshExport, UnknownExtensionAndMissingFolderAreRefused) {
  const Folder folder;
  test::expect_parts(test::refusal_of([&] { export_mesh(one_cell(), folder / "one.obj"); }),
                     {"one.obj: found extension '.obj', expected .vtu, .msh, .med, .unv, .inp, "
                      ".bdf, .nas or .dat"});
  test::expect_parts(
      test::refusal_of<FileError>([&] { export_mesh(one_cell(), folder / "none/one.vtu"); }),
      {"none/one.vtu: cannot be written (folder missing or disk full?)"});
}

}  // namespace
}  // namespace clatter::mesh
