// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices and DoF maps in text files: exact round trips, errors with file and line.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/matrix_text.hpp"
#include "core/base/whole_file.hpp"
#include "core/rom/dof_map.hpp"
#include "tests/random_matrix.hpp"
#include "tests/refusal.hpp"

namespace clatter {
namespace {

using test::expect_parts;
using test::refusal_of;

class MatrixTextTest : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) const {
    const auto path =
        std::filesystem::path(::testing::TempDir()) /
        (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".mtx");
    write_whole_file(path, text);
    return path;
  }
  std::string refusal(const std::string& text) const {
    return refusal_of([&] { read_matrix_text(file(text)); });
  }
};

constexpr const char* kHead = "%%MatrixMarket matrix coordinate real ";

TEST_F(MatrixTextTest, MatrixMarketReadsBackToTheLastBit) {
  Eigen::MatrixXd A = test::random_matrix(30, 30);
  A = (A * A.transpose() * 1e11 / 3.0).eval();
  A.diagonal().array() += 1e-7;
  A(7, 3) = A(3, 7) = 0.0;
  A(9, 2) = A(2, 9) = 5e-324;  // the smallest positive double
  const auto path = file("");
  write_matrix_market(path, A, {"a comment"});
  const SparseMatrix read = read_matrix_text(path);
  EXPECT_EQ(read.nonZeros(), 30 * 31 / 2 - 1);
  EXPECT_TRUE(
      (Eigen::MatrixXd(read).array() == Eigen::MatrixXd(A.triangularView<Eigen::Lower>()).array())
          .all());
}

TEST_F(MatrixTextTest, EveryFormMeansTheSameMatrix) {
  const Eigen::Matrix2d expected{{4.0, 0.0}, {-1.5, 3.0}};
  const std::string array = "%%MatrixMarket matrix array real ";
  for (const std::string& text :
       {kHead + std::string("symmetric\n% comment\n2 2 3\n1 1 4\n2 1 -1.5\n2 2 +3e0\n"),
        kHead + std::string("general\n2 2 4\n2 2 3\n1 2 -1.5\n2 1 -1.5\n1 1 4\n"),
        array + "general\n2 2\n4\n-1.5\n-1.5\n3\n",
        array + "symmetric\r\n2 2\r\n4\r\n-1.5\r\n3\r\n",
        std::string("1 1 4.\n1 2 -1.5\n2,1,-1.5\n2 2 3.\n")})
    EXPECT_EQ(Eigen::MatrixXd(read_matrix_text(file(text))), expected) << text;
}

TEST_F(MatrixTextTest, WhatIsWrongIsNamedWithItsLine) {
  expect_parts(refusal(""), {".mtx:0", "empty"});
  expect_parts(refusal("%%MatrixMarket matrix coordinate complex general\n"), {":1", "complex"});
  expect_parts(refusal(kHead + std::string("symmetric\n2 3 1\n")), {":2", "2 x 3", "square"});
  expect_parts(refusal(kHead + std::string("symmetric\n2 2 2\n1 1 1\n1 2 1\n2 2 1\n")),
               {":4", "lower triangle"});
  expect_parts(refusal(kHead + std::string("symmetric\n2 2 3\n1 1 1\n2 2 1\n")),
               {"found 2 entries", "expected 3"});
  expect_parts(refusal(kHead + std::string("general\n2 2 3\n1 1 1\n2 2 1\n1 2 1\n")),
               {":5", "row 1, column 2", "symmetric"});
  expect_parts(refusal("1 1 4\n1 2 -1\n2 1 -1.1\n2 2 4\n"), {":3", "-1.1", "symmetric"});
  expect_parts(refusal("1 1 4\n2 2 4\n1 1 5\n"), {":3", "row 1, column 1", "second time"});
  expect_parts(refusal("1 1 4\n2 2 x4\n"), {":2", "x4"});
  expect_parts(refusal("1 1 4\n2 2 nan\n"), {":2", "finite"});
  expect_parts(refusal("1 1 4\n0 2 1\n"), {":2", "index 0"});
  expect_parts(refusal("1 1 4\n2 2\n"), {":2", "2 numbers"});
  // A size that exceeds any memory is refused before allocation.
  expect_parts(refusal(kHead + std::string("symmetric\n2000000000 2000000000 1\n1 1 1\n")),
               {"found 1 entries", "2000000000 rows"});
  expect_parts(refusal_of([] { read_matrix_text("absent.mtx"); }), {"absent.mtx", "no such file"});
}

/// Two nodes of one set, a rotation, a slanted direction, and a mode.
rom::ReducedModel text_model() {
  rom::ReducedModel model;
  model.n_boundary = 5;
  model.M_rr = model.K_rr = Eigen::MatrixXd::Identity(6, 6);
  rom::DofSet& set = model.sets["a set"];
  set.kind = "node";
  set.dofs = {0, 1, 2, 3, 4};
  set.labels = {"p.x", "p.y", "p.rz", "wall[1,2]", "r.x"};
  set.position = Eigen::MatrixXd::Constant(5, 3, 1.0 / 3.0);
  set.position(4, 0) = 0.1;
  set.direction = Eigen::MatrixXd::Zero(5, 3);
  set.direction(0, 0) = set.direction(1, 1) = set.direction(2, 2) = set.direction(4, 0) = 1.0;
  set.direction.row(3) << 0.6, 0.8, 0.0;
  set.is_rotation = {0, 0, 1, 0, 0};
  return model;
}

TEST(DofMapTest, NodesAreSharedByComponentsAtOnePosition) {
  const std::vector<rom::MappedDof> map = rom::map_of(text_model());
  ASSERT_EQ(map.size(), 6u);
  const std::vector<std::pair<int, int>> expected{{1, 1}, {1, 2}, {1, 6}, {2, 0}, {3, 1}, {4, 0}};
  for (size_t j = 0; j < 6; ++j)
    EXPECT_EQ(std::pair(map[j].node, map[j].component), expected[j]) << j;
  EXPECT_EQ(map[5].kind, rom::MappedDof::Kind::kModal);
  EXPECT_EQ(map[5].label, "mode_1");
}

TEST(DofMapTest, AComponentAlongAxesOfTheDecksNodeCountsWhereTheDeckIsMet) {
  rom::ReducedModel model = text_model();
  model.deck.units = "mm-t-s";
  model.deck.largest_node = 8;
  model.sets["a set"].node_ids = {7, 7, 7, 8, 0};
  model.sets["a set"].components = {0, 0, 0, 2, 0};  // along the slanted direction
  const rom::MappedDof elsewhere = rom::map_of(model)[3];
  EXPECT_EQ(elsewhere.component, 0);
  EXPECT_FALSE(elsewhere.of_deck);
  const rom::MappedDof in_deck = rom::map_of(model, {.deck_axes = true})[3];
  EXPECT_EQ(std::pair(in_deck.node, in_deck.component), std::pair(8, 2));
  EXPECT_TRUE(in_deck.turned);
}

TEST(DofMapTest, TheMapReadsBackToTheLastBit) {
  const std::vector<rom::MappedDof> map = rom::map_of(text_model());
  const auto path = std::filesystem::path(::testing::TempDir()) / "round.dofs.tsv";
  rom::write_dof_map(path, map);
  const std::vector<rom::MappedDof> read = rom::read_dof_map(path);
  ASSERT_EQ(read.size(), map.size());
  for (size_t j = 0; j < map.size(); ++j) {
    EXPECT_EQ(std::tie(read[j].kind, read[j].node, read[j].component, read[j].position,
                       read[j].direction, read[j].set, read[j].label),
              std::tie(map[j].kind, map[j].node, map[j].component, map[j].position,
                       map[j].direction, map[j].set, map[j].label));
  }
}

TEST(DofMapTest, WhatIsWrongIsNamedWithItsLine) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "wrong.dofs.tsv";
  const auto refusal = [&](const std::string& line) {
    write_whole_file(path, "# comment\n" + line);
    return refusal_of([&] { rom::read_dof_map(path); });
  };
  expect_parts(refusal("1 1 1\n"), {"wrong.dofs.tsv:2", "1 columns", "tabs"});
  expect_parts(refusal("2\t1\t1\tdisplacement\t0\t0\t0\t1\t0\t0\ts\tl\n"),
               {":2", "row 2", "row 1"});
  expect_parts(refusal("1\t0\t1\tdisplacement\t0\t0\t0\t1\t0\t0\ts\tl\n"), {":2", "node 0"});
  expect_parts(refusal("1\t1\t2\tdisplacement\t0\t0\t0\t1\t0\t0\ts\tl\n"), {":2", "component 2"});
  expect_parts(refusal("1\t1\t0\tshift\t0\t0\t0\t1\t0\t0\ts\tl\n"), {":2", "shift"});
  expect_parts(refusal("1\t1\t0\trotation\t0\t0\t0\t1\t1\t0\ts\tl\n"), {":2", "unit vector"});
  expect_parts(refusal("1\t1\t1\tdisplacement\t0\t0\t0\t1\t0\t0\ts\tl\n"
                       "2\t1\t2\tdisplacement\t0\t0\t1\t0\t1\t0\ts\tm\n"),
               {":3", "node 1", "position"});
  expect_parts(refusal(""), {"no degree of freedom"});
}

}  // namespace
}  // namespace clatter
