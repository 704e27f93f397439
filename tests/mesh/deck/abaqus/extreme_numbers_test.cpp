// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of nodes and elements at the end of 32 bits.
#include <fmt/format.h>

#include "tests/mesh/deck/abaqus/support.hpp"
#include "tests/mesh/support.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh::deck {
namespace {

/// A tetrahedron whose node k of 0 to 3 has the number first + k * step.
std::string tetrahedron(int64_t first, int64_t step, int64_t element) {
  return fmt::format(
      "*NODE\n{0},0,0,0\n{1},1,0,0\n{2},0,1,0\n{3},0,0,1\n*ELEMENT, TYPE=C3D4, ELSET=E\n"
      "{4},{0},{1},{2},{3}\n",
      first, first + step, first + 2 * step, first + 3 * step, element);
}

TEST(HardF14, NumbersUpToTheLargestInt32GiveTheSameMesh) {
  constexpr int64_t kLargest = 2147483647;
  const Deck plain = testing::read(tetrahedron(1, 1, 1));
  for (const auto& [first, step] : {std::pair{kLargest - 3, int64_t{1}},
                                    {int64_t{1}, kLargest / 3},
                                    {int64_t{7}, int64_t{1000}}}) {
    const Deck deck = testing::read(tetrahedron(first, step, kLargest));
    EXPECT_EQ(deck.mesh.nodes, plain.mesh.nodes);
    EXPECT_EQ(deck.mesh.cells.front().nodes, plain.mesh.cells.front().nodes);
    EXPECT_EQ(deck.mesh.node_ids.at(3), first + 3 * step);
  }
  test::observed("numbers up to 2147483647, with gaps: the same mesh");
}

TEST(HardF14, LargerNumbersAreRefusedWithTheRange) {
  for (const int64_t first : {int64_t{2147483645}, int64_t{1} << 33, int64_t{1} << 62}) {
    const std::string message = testing::refusal(tetrahedron(first, 1, 1));
    EXPECT_NE(message.find("expected the number of a node (1 to 2147483647)"), std::string::npos)
        << message;
    test::observed("refused: " + message);
  }
  EXPECT_NE(testing::refusal(tetrahedron(1, 1, int64_t{1} << 31))
                .find("expected the number of an element (1 to 2147483647)"),
            std::string::npos);
}

}  // namespace
}  // namespace clatter::mesh::deck
