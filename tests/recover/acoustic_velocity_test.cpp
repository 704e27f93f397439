// SPDX-License-Identifier: GPL-3.0-or-later
// Normal velocity of the acoustic skin: means over triangles, its part of a sound file, its lines.
#include <gtest/gtest.h>

#include <cmath>

#include "recover/acoustic/acoustic_skin.hpp"
#include "recover/acoustic/velocity_map.hpp"
#include "recover/sound/acoustic_velocity.hpp"
#include "synthetic.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;

TEST(AcousticVelocity, MeansOfCornersByHand) {
  Eigen::MatrixXd corners(6, 2);
  corners << 1, 0, 2, 0, 6, 3, 0, -1, 0, -1, 0, -1;
  EXPECT_EQ(triangle_means(corners), (Eigen::MatrixXd(2, 2) << 3, 1, 0, -1).finished());
}

TEST(AcousticVelocity, SphereMovesAlongItsNormalsAndKeepsTheFlux) {
  constexpr double kBall = 0.2;  // radius [m]
  Mesh6 mesh = unit_sphere(2);
  mesh.nodes *= kBall;
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(mesh.nodes.size(), 2);  // radial, along z
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) {
    motions.block(3 * n, 0, 3, 1) = mesh.nodes.row(n).transpose() / kBall;
    motions(3 * n + 2, 1) = 1.0;
  }
  const rom::ReducedModel model = model_on(mesh, RowMatrix(motions), 2000.0);
  const sound::Surface skin = acoustic_skin(model.skin, {0.05, 8.0}, 343.2, 700.0).surface;
  const Exposure exposed{std::vector<bool>(static_cast<size_t>(mesh.triangles.rows()), true), {}};
  const VelocityMap map = velocity_map(model.skin, exposed, skin, LidMotion::kRest);
  const Eigen::MatrixXd found = triangle_means(map.map * motions);
  const SkinGeometry geometry = measure_skin(mesh.nodes, mesh.triangles);
  EXPECT_NEAR(skin.face_area.dot(found.col(0)) / geometry.area, 1.0, 1e-3);
  EXPECT_NEAR(skin.face_area.dot(found.col(1)), 0.0, 1e-12 * geometry.area);
  for (Eigen::Index c = 0; c < found.rows(); ++c)
    EXPECT_NEAR(found(c, 1), skin.face_normal(c, 2), 0.17) << c;
  EXPECT_NEAR(std::sqrt((found.col(0).array() - 1.0).square().mean()), 0.0, 0.1);
}

/// A sound file with what the normal velocity needs: a tetrahedron of two coordinates.
class AcousticFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    tetrahedron_.nodes = RowMatrix(4, 3);
    tetrahedron_.nodes << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    tetrahedron_.triangles = IndexMatrix(4, 3);
    tetrahedron_.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    tetrahedron_.per_reduced = Eigen::MatrixXd(4, 2);
    tetrahedron_.per_reduced << 1, 0, 2, -1, 0, 3, 4, 0.5;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Reads back a file with this velocity; none without.
  std::optional<AcousticVelocity> through_file(const Eigen::MatrixXd* velocity) {
    H5File file = H5File::create(folder_ / "part.sound.h5");
    file.write("skin/nodes", tetrahedron_.nodes);
    file.write("skin/triangles", tetrahedron_.triangles);
    if (velocity != nullptr) file.write("skin/normal_velocity", *velocity);
    file.commit();
    return read_acoustic_velocity(folder_ / "part.sound.h5", 2);
  }

  std::filesystem::path folder_;
  AcousticVelocity tetrahedron_;
};

TEST_F(AcousticFile, ComesBackAndMayBeAbsent) {
  const auto back = through_file(&tetrahedron_.per_reduced);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->nodes, tetrahedron_.nodes);
  EXPECT_EQ(back->triangles, tetrahedron_.triangles);
  EXPECT_EQ(back->per_reduced, tetrahedron_.per_reduced);
  EXPECT_FALSE(through_file(nullptr));
}

TEST_F(AcousticFile, InvalidContentIsRefused) {
  const Eigen::MatrixXd narrow = tetrahedron_.per_reduced.leftCols(1);
  test::expect_parts(test::refusal_of([&] { through_file(&narrow); }),
                     {"part.sound.h5: skin/normal_velocity: found shape (4, 1), expected (4, 2)"});
  Eigen::MatrixXd broken = tetrahedron_.per_reduced;
  broken(0, 0) = std::nan("");
  test::expect_parts(test::refusal_of([&] { through_file(&broken); }),
                     {"part.sound.h5: skin/normal_velocity: found NaN or infinity"});
  tetrahedron_.triangles(2, 1) = 4;
  test::expect_parts(test::refusal_of([&] { through_file(&tetrahedron_.per_reduced); }),
                     {"part.sound.h5: skin/triangles: found nodes outside of 0 to 3"});
}

TEST_F(AcousticFile, LinesAreProductsWithTheReducedVelocities) {
  LineSpectrum velocity;
  velocity.frequency_hz = Eigen::Vector3d(0, 10, 20);
  velocity.amplitude = Eigen::MatrixXcd::Zero(3, 2);
  velocity.amplitude(2, 0) = {1.0, 2.0};
  velocity.amplitude(2, 1) = {0.0, -4.0};
  const auto path = folder_ / "field.h5";
  H5File file = H5File::create(path);
  write_acoustic_lines(file, tetrahedron_, velocity, {{2, 20.0}});
  file.commit();
  const H5File back = H5File::open(path);
  EXPECT_EQ(back.read_index_matrix("acoustic/triangles"), tetrahedron_.triangles);
  EXPECT_EQ(back.read_vector("lines/acoustic_normal_velocity_re/00000"),
            Eigen::Vector4d(1, 2, 0, 4));
  EXPECT_EQ(back.read_vector("lines/acoustic_normal_velocity_im/00000"),
            Eigen::Vector4d(2, 8, -12, 6));
}

}  // namespace
}  // namespace clatter::recover
