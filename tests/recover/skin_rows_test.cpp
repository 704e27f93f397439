// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of T read from the file of the reduced model block by block, against T in memory.
#include "core/rom/skin_rows.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/base/artefact.hpp"
#include "recover/field/skin_writer.hpp"
#include "recover/skin/radiated_power.hpp"
#include "synthetic.hpp"
#include "tests/random_matrix.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;
namespace fs = std::filesystem;

/// A reduced model in a file, with its skin; T is on disk.
class SkinOnDisk : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fresh_folder(test->name());
    T_ = random_rows(mesh_, 7, 3);
    write(T_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const RowMatrix& T) {
    rom::ReducedModel model = model_on(mesh_, T, 2000.0);
    model.skin.faces = {{"low", {0, 5}}, {"skin", {1, 2, 3}}};
    H5File file = H5File::create(folder_ / "rom.h5");
    rom::write_reduced_model(file, model);
    write_provenance(file, {"clatter/rom/1", "", {}});
    file.commit();
  }
  rom::SkinRows on_disk() const { return rom::SkinRows(folder_ / "rom.h5", 0); }

  fs::path folder_;
  Mesh6 mesh_ = unit_sphere(2);
  RowMatrix T_;
};

TEST_F(SkinOnDisk, RowsAreThoseInMemoryWhateverTheBlock) {
  const rom::SkinRows disk = on_disk(), kept(folder_ / "rom.h5"), memory(T_);
  EXPECT_FALSE(disk.in_memory());
  EXPECT_TRUE(kept.in_memory());
  RowMatrix buffer;
  for (const auto& [first, count] : {std::pair{0, 1}, {5, 300}, {1900, 26}, {0, 1926}}) {
    for (const rom::SkinRows* rows : {&disk, &kept, &memory})
      EXPECT_EQ(RowMatrix(rows->read(first, count, buffer)),
                RowMatrix(T_.middleRows(first, count)));
  }
  const std::vector<int32_t> nodes{0, 1, 4, 5, 90, 641};
  const RowMatrix some = disk.of_nodes(nodes);
  for (size_t k = 0; k < nodes.size(); ++k)
    EXPECT_EQ(RowMatrix(some.middleRows(3 * k, 3)), RowMatrix(T_.middleRows(3 * nodes[k], 3)));
}

TEST_F(SkinOnDisk, GeometryAndSurfacesAreReadWithoutTheRows) {
  const rom::Skin skin = rom::read_skin_geometry(folder_ / "rom.h5");
  EXPECT_EQ(skin.T.size(), 0);
  EXPECT_EQ(skin.nodes, mesh_.nodes);
  EXPECT_EQ(skin.triangles, mesh_.triangles);
  EXPECT_EQ(skin.faces.at("low"), (std::vector<int32_t>{0, 5}));
  EXPECT_EQ(rom::read_reduced_model(folder_ / "rom.h5").skin.faces, skin.faces);
}

TEST_F(SkinOnDisk, DamagedRowsAndSurfacesAreRefused) {
  RowMatrix damaged = T_;
  damaged(1000, 2) = std::numeric_limits<double>::quiet_NaN();
  write(damaged);
  RowMatrix buffer;
  EXPECT_NO_THROW(on_disk().read(0, 1000, buffer));
  test::expect_parts(test::refusal_of([&] { on_disk().read(900, 200, buffer); }),
                     {"rom.h5: skin/T: rows 900 to 1100: found a value that is not finite"});
  rom::ReducedModel model = model_on(mesh_, T_, 2000.0);
  for (const std::vector<int32_t>& faces : {std::vector<int32_t>{3, 2}, {0, 320}, {-1}}) {
    model.skin.faces = {{"deck", faces}};
    H5File file = H5File::create(folder_ / "bad.h5");
    rom::write_reduced_model(file, model);
    write_provenance(file, {"clatter/rom/1", "", {}});
    file.commit();
    test::expect_parts(test::refusal_of([&] { rom::read_skin_geometry(folder_ / "bad.h5"); }),
                       {"skin/faces/deck: found triangle", "expected ascending numbers below 320"});
  }
}

TEST_F(SkinOnDisk, FormsOfThePanelsAreTheSameToTheBit) {
  const SkinGeometry geometry = measure_skin(mesh_.nodes, mesh_.triangles);
  const auto panels = choose_panels(default_panels({}), bare_skin(mesh_), geometry);
  const rom::Skin skin{mesh_.nodes, mesh_.triangles};
  const auto disk = normal_velocity_forms(skin, on_disk(), geometry, panels);
  const auto memory = normal_velocity_forms(skin, rom::SkinRows(T_), geometry, panels);
  for (size_t p = 0; p < panels.size(); ++p) EXPECT_EQ(disk[p].W, memory[p].W) << panels[p].name;
}

TEST_F(SkinOnDisk, WrittenFieldsEqualTheWholeProduct) {
  const SkinGeometry geometry = measure_skin(mesh_.nodes, mesh_.triangles);
  const SparseRows normal = face_normal_operator(mesh_.nodes, mesh_.triangles, geometry);
  const Eigen::MatrixXd q = test::random_matrix(7, 3);
  const Eigen::MatrixXd u = T_ * q, v_n = normal * u;
  const std::vector<SkinDatasets> columns{{"u/0", "n/0"}, {"u/1", ""}, {"", "n/2"}};
  for (const bool single : {true, false}) {
    const rom::SkinRows rows = on_disk();
    H5File file = H5File::create(folder_ / "field.h5");
    SkinWriter(rows, normal).write(file, q, columns, single);
    file.commit();
    const H5File read = H5File::open(folder_ / "field.h5");
    const double tolerance = single ? 1e-6 : 1e-13;  // seven terms of size one
    for (int c : {0, 1}) {
      const RowMatrix got = read.read_rows("u/" + std::to_string(c));
      EXPECT_LT((got.reshaped<Eigen::RowMajor>() - u.col(c)).cwiseAbs().maxCoeff(), tolerance);
    }
    for (int c : {0, 2})
      EXPECT_LT((read.read_vector("n/" + std::to_string(c)) - v_n.col(c)).cwiseAbs().maxCoeff(),
                tolerance);
    EXPECT_FALSE(read.has("u/2"));
    EXPECT_FALSE(read.has("n/1"));
  }
}

TEST(ExpansionBlocks, AlignWithTheChunksOfTheFileInBothPrecisions) {
  for (const int64_t nodes : {1, 5000, 100000}) {
    const int64_t single = H5File::rows_of_a_chunk({nodes, 3}, true);
    EXPECT_EQ(single % H5File::rows_of_a_chunk({nodes, 3}, false), 0) << nodes;
    EXPECT_LE(single, nodes);
  }
}

}  // namespace
}  // namespace clatter::recover
