// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "assembly/model/fe_certificate.hpp"
#include "block_mesh.hpp"
#include "core/base/artefact.hpp"
#include "core/fe/fe_model.hpp"
#include "core/mesh/mesh_file.hpp"
#include "tests/paths.hpp"
#include "tests/scratch.hpp"

namespace clatter::assembly::testing {
namespace {

constexpr const char* kSteelLines =
    "[material.steel]\nregions = [\"body\"]\nE_gpa = 210.0\nnu = 0.3\nrho = 7800.0\n";

class AssemblyCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch_path("asm");
    std::filesystem::create_directories(folder_);
    save(block_mesh({2, 1, 1}, brick({0.2, 0.1, 0.1})));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void save(const mesh::Mesh& mesh) const {
    H5File file = H5File::create(folder_ / "part.mesh.h5");
    write_provenance(file, {mesh::kMeshSchema, "", {}});
    mesh::write_mesh(file, mesh);
    file.commit();
  }
  void recipe(const std::string& toml) const { std::ofstream(folder_ / "part.fe.toml") << toml; }
  /// Exit code; what the command printed on stderr is in `said_`.
  int run(const std::string& arguments = "part.mesh.h5 -c part.fe.toml -o part.fe.h5") {
    const std::string command = "cd '" + folder_.string() +
                                "' && '" CLATTER_BIN_DIR "/clatter-assembly' " + arguments +
                                " > out.txt 2> err.txt";
    const int status = std::system(command.c_str());
    std::stringstream text;
    text << std::ifstream(folder_ / "err.txt").rdbuf();
    said_ = text.str();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  bool has_output() const { return std::filesystem::exists(folder_ / "part.fe.h5"); }
  /// Exactly one line with "error:" that contains all parts; no output file.
  void expect_refusal(int code, const std::vector<std::string>& parts) {
    EXPECT_EQ(run(), code) << said_;
    const size_t at = said_.find("error: ");
    ASSERT_NE(at, std::string::npos) << said_;
    EXPECT_EQ(said_.find('\n', at), said_.size() - 1) << said_;
    for (const std::string& part : parts)
      EXPECT_NE(said_.find(part, at), std::string::npos) << part << " in: " << said_;
    EXPECT_FALSE(has_output());
  }

  std::filesystem::path folder_;
  std::string said_;
};

TEST_F(AssemblyCommand, WritesAModelWithCertificateInputsAndTiming) {
  recipe(kSteelLines);
  ASSERT_EQ(run("part.mesh.h5 -c part.fe.toml -o part.fe.h5 --depfile part.d --json"), 0) << said_;
  const fe::FeModel model = fe::read_fe_model(folder_ / "part.fe.h5");
  EXPECT_NEAR(model.mass.mass, 7800.0 * 0.002, 1e-10);
  const H5File file = H5File::open(folder_ / "part.fe.h5");
  EXPECT_LT(read_certificate<FeCertificate>(file).mass_error.value(), 1e-9);
  EXPECT_TRUE(file.has("timing"));
  EXPECT_TRUE(file.has("inputs"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "part.d"));
}

TEST_F(AssemblyCommand, SameInputGivesTheSameMatrixBits) {
  recipe(std::string(kSteelLines) + "[[coupling]]\nname = \"end\"\nsurface = \"x1\"\n");
  ASSERT_EQ(run(), 0) << said_;
  const fe::FeModel first = fe::read_fe_model(folder_ / "part.fe.h5");
  ASSERT_EQ(run("part.mesh.h5 -c part.fe.toml -o part.fe.h5 --threads 1"), 0) << said_;
  const fe::FeModel second = fe::read_fe_model(folder_ / "part.fe.h5");
  EXPECT_EQ((first.K - second.K).norm(), 0.0);
  EXPECT_EQ((first.M - second.M).norm(), 0.0);
}

TEST_F(AssemblyCommand, HelpTeachesWithASample) {
  EXPECT_EQ(run("--help"), 0);
  std::stringstream text;
  text << std::ifstream(folder_ / "out.txt").rdbuf();
  EXPECT_NE(text.str().find("clatter-assembly block.mesh.h5 -c block.fe.toml -o block.fe.h5"),
            std::string::npos);
}

TEST_F(AssemblyCommand, AMissingMeshIsBadInput) {
  recipe(kSteelLines);
  std::filesystem::remove(folder_ / "part.mesh.h5");
  EXPECT_EQ(run(), 2) << said_;
  EXPECT_FALSE(has_output());
}

TEST_F(AssemblyCommand, AnUnknownSurfaceIsRefusedWithTheNamesPresent) {
  recipe(std::string(kSteelLines) + "[[support]]\nsurface = \"deck\"\n");
  expect_refusal(2, {"part.fe.toml:", "deck", "skin, x0, x1"});
}

TEST_F(AssemblyCommand, ANegativeDensityIsRefused) {
  recipe("[material.steel]\nregions = [\"body\"]\nE_gpa = 210.0\nnu = 0.3\nrho = -1.0\n");
  expect_refusal(2, {"rho", "-1"});
}

TEST_F(AssemblyCommand, AnInvertedCellIsRefused) {
  mesh::Mesh mesh = block_mesh({2, 1, 1}, brick({0.2, 0.1, 0.1}));
  mesh.cells[0].nodes.col(0).swap(mesh.cells[0].nodes.col(1));
  save(mesh);
  recipe(kSteelLines);
  expect_refusal(2, {"part.mesh.h5", "inverted"});
}

TEST_F(AssemblyCommand, APatchThatCatchesNothingIsRefused) {
  BlockOptions options;
  options.curved = options.wrap_x = true;
  save(block_mesh({8, 1, 2}, ring(0.05, 0.06, 0.1), options));
  recipe(std::string(kSteelLines) + R"([[contact]]
name = "liner"
surface = "y0"
axis_point = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
zero_angle = [0.0, 1.0, 0.0]
axial = [0.2, 0.3]
rows = 3
[[contact.sector]]
centre_deg = 0.0
half_width_deg = 40.0
strips = 2
)");
  expect_refusal(2, {"contact liner", "patch [0,0]", "caught no node"});
}

TEST_F(AssemblyCommand, AFailureLeavesTheOldModelUntouched) {
  recipe(kSteelLines);
  ASSERT_EQ(run(), 0) << said_;
  const std::string before = sha256_of_file(folder_ / "part.fe.h5");
  recipe("[material.steel]\nregions = [\"body\"]\nE_gpa = 210.0\nnu = 0.7\nrho = 1.0\n");
  EXPECT_EQ(run(), 2);
  EXPECT_EQ(sha256_of_file(folder_ / "part.fe.h5"), before);
}

}  // namespace
}  // namespace clatter::assembly::testing
