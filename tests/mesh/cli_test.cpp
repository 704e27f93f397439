// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-mesh from the command line: exit codes, one line on stderr, no files left.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/mesh/mesh_file.hpp"
#include "support.hpp"
#include "tests/paths.hpp"

namespace clatter::mesh {
namespace {

using testing::Folder;

struct Outcome {
  int code;
  std::string out, err;
};

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

Outcome run(const Folder& folder, const std::string& arguments) {
  const std::string command = std::string(CLATTER_BIN_DIR) + "/clatter-mesh " + arguments + " >" +
                              (folder / "out").string() + " 2>" + (folder / "err").string();
  const int status = std::system(command.c_str());
  return {WEXITSTATUS(status), text_of(folder / "out"), text_of(folder / "err")};
}

std::string put(const Folder& folder, const std::string& text) {
  std::ofstream(folder / "part.mesh.toml") << text;
  return (folder / "part.mesh.toml").string();
}

const std::string kBeam =
    "name = 'beam'\nkind = 'box'\n[box]\nsize = [60, 20, 10]\n[mesh]\nelement_size_mm = 12\n";

TEST(CliMesh, MakesTheMeshTheStepFileAndTheExports) {
  const Folder folder;
  const std::string part = put(folder, kBeam), mesh = (folder / "beam.mesh.h5").string();
  const Outcome o =
      run(folder, part + " -o " + mesh + " --json --write-step " + (folder / "beam.step").string() +
                      " --export " + (folder / "beam.vtu").string() + " --export " +
                      (folder / "beam.msh").string());
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out.front(), '{');
  EXPECT_EQ(std::count(o.out.begin(), o.out.end(), '\n'), 1);
  EXPECT_GT(read_mesh(mesh).cell_count(), 10);
  for (const char* name : {"beam.step", "beam.vtu", "beam.msh"}) {
    EXPECT_GT(std::filesystem::file_size(folder / name), 1000u) << name;
  }
  // And from the STEP file that was written.
  const std::string again = put(folder,
                                "name = 'beam'\nkind = 'cad'\n[cad]\nsource = 'beam.step'\n"
                                "[surface.clamp]\nplane = { normal = [1, 0, 0], height = 0 }\n");
  EXPECT_EQ(run(folder, again + " -o " + (folder / "again.mesh.h5").string()).code, 0);
  EXPECT_GT(read_mesh(folder / "again.mesh.h5").surface("clamp").face_count(), 0);
}

TEST(CliMesh, ReadsItsOwnGmshFileBackAndRefusesWhatNoGroupClaims) {
  const Folder folder;
  const std::string msh = (folder / "beam.msh").string(), again = (folder / "again.h5").string();
  ASSERT_EQ(run(folder, put(folder, kBeam) + " -o " + (folder / "beam.h5").string() +
                            " --quiet --export " + msh)
                .code,
            0);
  const Outcome no_units = run(folder, msh + " -o " + again + " --quiet");
  EXPECT_EQ(no_units.code, 2);
  EXPECT_NE(no_units.err.find("--units"), std::string::npos) << no_units.err;
  EXPECT_EQ(run(folder, msh + " --units m-kg-s -o " + again + " --quiet").code, 0);
  const Mesh first = read_mesh(folder / "beam.h5"), second = read_mesh(again);
  EXPECT_EQ(first.nodes, second.nodes);
  EXPECT_EQ(first.node_sets, second.node_sets);
  EXPECT_EQ(first.cells[0].nodes, second.cells[0].nodes);
  const Outcome skipped =
      run(folder, msh + " --units m-kg-s --ignore solid -o " + again + " --quiet");
  EXPECT_EQ(skipped.code, 2);  // no cell remains
}

void expect_refused(const std::string& toml, int code, const std::string& text) {
  const Folder folder;
  std::ofstream(folder / "old.mesh.h5") << "precious";
  const Outcome o =
      run(folder, put(folder, toml) + " -o " + (folder / "old.mesh.h5").string() + " --quiet");
  EXPECT_EQ(o.code, code) << o.err;
  EXPECT_NE(o.err.find(text), std::string::npos) << o.err;
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  EXPECT_EQ(text_of(folder / "old.mesh.h5"), "precious");
}

// A foil of 0.01 mm in cells of 12 mm: angles of 0.05 deg, whatever the mesh.
TEST(CliMesh, HardG8_TooPoorCellsAreRefusedWithPositionsUnlessAccepted) {
  const Folder folder;
  // So thin that every cell is flat, by any version of Gmsh.
  const std::string toml =
      "name = 'foil'\nkind = 'box'\n[box]\nsize = [60, 20, 0.005]\n"
      "[mesh]\nelement_size_mm = 12\nrefine_passes = 0\n";
  const std::string mesh = (folder / "foil.mesh.h5").string();
  const Outcome refused = run(folder, put(folder, toml) + " -o " + mesh + " --quiet");
  EXPECT_EQ(refused.code, 3) << refused.err;
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  for (const char* text :
       {"too poor to be trusted", " deg in cell ", " mm, ", "--accept-poor-cells",
        "; tried in vain: element_size_mm = 4.4; elements_per_turn = 12; mend its smallest "
        "features "
        "in the CAD program: ",
        "faces from 0.005 wide (0.005 at ("})
    EXPECT_NE(refused.err.find(text), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(mesh));

  const std::string deck = (folder / "foil.inp").string();
  const Outcome accepted = run(
      folder, put(folder, toml) + " -o " + mesh + " --quiet --accept-poor-cells --export " + deck);
  EXPECT_EQ(accepted.code, 0) << accepted.err;
  EXPECT_NE(accepted.err.find("warning: mesh: "), std::string::npos) << accepted.err;
  EXPECT_EQ(run(folder, put(folder, toml + "accept_poor_cells = true\n") + " -o " + mesh).code, 0);

  // The user's own mesh is never refused by quality.
  const Outcome imported = run(folder, deck + " --units m-kg-s -o " + mesh + " --quiet");
  EXPECT_EQ(imported.code, 0) << imported.err;
  EXPECT_NE(imported.err.find("are poor: "), std::string::npos) << imported.err;
}

TEST(CliMesh, CheckListsADeckAndWritesNothing) {
  const Folder folder;
  const std::string deck = (folder / "t.bdf").string();
  const std::string tet =
      "PSOLID,1,1\nMAT1,1,210.,,.3,7.8\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n"
      "GRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\n";
  std::ofstream(deck) << tet << "ENDDATA\n";
  const Outcome read = run(folder, deck + " --check");
  EXPECT_EQ(read.code, 0) << read.err;
  EXPECT_NE(read.out.find("4  card GRID"), std::string::npos) << read.out;
  EXPECT_NE(read.out.find("is read: nodes: 4, cells: 1"), std::string::npos) << read.out;

  std::ofstream(deck) << tet << "CBEND,1,1,1,2\nENDDATA\n";
  const Outcome refused = run(folder, deck + " --check");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.out.find("card CBEND"), std::string::npos) << refused.out;
  EXPECT_NE(refused.err.find("1 row is refused, see the table"), std::string::npos) << refused.err;
  EXPECT_EQ(run(folder, deck + " --check --ignore CBEND").code, 0);
  const Outcome json = run(folder, deck + " --check --json");
  EXPECT_EQ(json.code, 2);
  EXPECT_EQ(json.out.find("{\"rows\": ["), 0u) << json.out;

  const Outcome no_output = run(folder, deck + " --units m-kg-s");
  EXPECT_EQ(no_output.code, 2);
  EXPECT_NE(no_output.err.find("--output is required"), std::string::npos) << no_output.err;
}

TEST(CliMesh, UnknownKeyIsBadInput) {
  expect_refused(kBeam + "elements_per_trun = 3\n", 2, "elements_per_turn");
}

TEST(CliMesh, SurfaceThatSelectsNothingIsBadInput) {
  expect_refused(kBeam + "[surface.hole]\nplane = { normal = [1, 0, 0], height = 61 }\n", 2,
                 "surface 'hole' selects no face");
}

TEST(CliMesh, MissingCadFileIsBadInput) {
  expect_refused("name = 'x'\nkind = 'cad'\n[cad]\nsource = 'none.step'\n", 2, "none.step");
}

TEST(CliMesh, MissingDescriptionIsBadInputAndMissingFolderFileTrouble) {
  const Folder folder;
  EXPECT_EQ(run(folder, "/nowhere/part.mesh.toml -o x.h5").code, 2);
  EXPECT_EQ(run(folder, put(folder, kBeam) + " -o /nowhere/beam.mesh.h5 --quiet").code, 4);
  EXPECT_EQ(run(folder, "--help").code, 0);
}

}  // namespace
}  // namespace clatter::mesh
