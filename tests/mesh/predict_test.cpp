// SPDX-License-Identifier: GPL-3.0-or-later
// The number of cells is known before meshing to a factor of two, and absurd ones are refused.
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "mesh_toml.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using testing::mesh_toml;

const std::string kBox = "name = 'b'\nkind = 'box'\n[box]\nsize = [60, 20, 10]\n[mesh]\n";
const std::string kPredictedTube =
    "name = 't'\nkind = 'cylinder'\n[cylinder]\nradius = 40\ninner_radius = 10\nlength = "
    "40\n[mesh]\n";

// What makes a mesh finer than its sizes say (slivers, short edges) makes a factor of two; an order
// of magnitude is what the limit is for.
TEST(Predict, CellsWithinAFactorOfTwo) {
  const std::vector<std::string> parts = {
      kBox + "element_size_mm = 5\n",
      kBox + "element_size_mm = 3\n",
      kPredictedTube + "element_size_mm = 8\n",
      kPredictedTube + "element_size_mm = 20\nelements_per_turn = 24\n",
      kPredictedTube +
          "element_size_mm = 12\n[[mesh.local]]\nsurface = 'inner'\nelements_per_turn = 24\n",
      kPredictedTube + "element_size_mm = 12\n[[mesh.local]]\nsurface = 'outer'\nfactor = 0.3\n",
      "name = 'thin'\nkind = 'cylinder'\n[cylinder]\nradius = 30\ninner_radius = 29\nlength = 60\n"
      "[mesh]\nelement_size_mm = 6\n"};
  for (const std::string& part : parts) {
    const auto certificate = mesh_toml(part).part.certificate;
    const double ratio = certificate.predicted_cells.value() / certificate.cells;
    EXPECT_GT(ratio, 0.5) << part;
    EXPECT_LT(ratio, 2.0) << part;
  }
}

/// Refused before any cell is made.
void expect_prediction_refused(const std::string& toml, const std::vector<std::string>& says) {
  const PartFile file = part_keys().read(Config::parse(toml, "part.toml"));
  GmshSession session(file.name);
  const PartGeometry part = build_part(session, file.shape);
  test::expect_parts(test::refusal_of([&] {
                       mesh_part(session, part, file.mesh, file.shape.unit.metres, file.name,
                                 "part.toml");
                     }),
                     says);
  test::expect_parts(test::refusal_of<NumericsError>([&] { session.extract(); }), {"got no cells"});
}

TEST(Predict, ASizeTypedInMetresIsRefusedBeforeMeshing) {
  expect_prediction_refused(kBox + "element_size_mm = 0.012\n",
                            {"part.toml", "element_size_mm = 0.012", "60 x 20 x 10 mm",
                             "e+10 cells", "max_cells", "unit is right"});
  expect_prediction_refused("length_unit = 'm'\n" + kBox + "element_size_mm = 12\n",
                            {"6e+04 x 2e+04 x 1e+04 mm"});
  expect_prediction_refused(
      kPredictedTube + "element_size_mm = 10\nelements_per_turn = 900\nmax_cells = 1e5\n",
      {"elements_per_turn = 900"});
}

TEST(Predict, TheLimitIsASettingAndMustBePositive) {
  expect_prediction_refused(kBox + "element_size_mm = 6\nmax_cells = 50\n",
                            {"at most 50 (max_cells)"});
  EXPECT_NO_THROW(mesh_toml(kBox + "element_size_mm = 6\nmax_cells = 5000\n"));
  test::expect_parts(test::refusal_of([&] { mesh_toml(kBox + "max_cells = 0\n"); }),
                     {"part.toml:", "mesh.max_cells: found 0, expected a number above 0"});
}

}  // namespace
}  // namespace clatter::mesh
