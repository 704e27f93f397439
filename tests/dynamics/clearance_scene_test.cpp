// SPDX-License-Identifier: GPL-3.0-or-later
// [contact] with the smallest warm gap instead of a clearance.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

class WarmClearanceScene : public testing::SlapScenes {
 protected:
  /// The base with this line in the place of its clearance.
  void replace_clearance(const std::string& line) {
    std::ifstream in(folder_ / "slap.run.toml");
    std::stringstream text;
    text << in.rdbuf();
    std::string scene = text.str();
    const std::string given = "clearance_um = 20.0\n";
    scene.replace(scene.find(given), given.size(), line);
    std::ofstream(folder_ / "slap.run.toml") << scene;
  }
  RowMatrix motion(const std::string& name, const std::string& changes) {
    return recorded(scene("[time]\ncycles = 1\n" + changes), name).read_rows("bodies/piston/q");
  }
};

// The bore is 8 um wider and the skirt 50 um larger: 42 um more of clearance leave the same gap.
TEST_F(WarmClearanceScene, LeavesTheGapOfAClearanceBetweenColdSurfaces) {
  const std::string shapes =
      "[[contact.bore_shape]]\norder = 0\nheight_mm = [0]\namplitude_um = [8]\n"
      "[[contact.skirt_shape]]\norder = 0\nheight_mm = [0]\namplitude_um = [50]\n";
  const std::string full = "[contact]\ncavitation = false\n";
  const RowMatrix given = motion("given", full + "clearance_um = 62\n" + shapes);
  const RowMatrix far = motion("far", full + "clearance_um = 63\n" + shapes);
  replace_clearance("minimum_warm_clearance_um = 20.0\n");
  const Scene warm = scene("[time]\ncycles = 1\n" + shapes);
  const std::vector<std::string> lines = build_model(warm, load_bodies(warm))->effects.lines(false);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
    return line.find("minimum warm clearance") != std::string::npos &&
           line.find("on") != std::string::npos &&
           line.find("62 um of clearance between the cold surfaces") != std::string::npos &&
           line.find("0 deg around") != std::string::npos;
  })) << fmt::format("{}", fmt::join(lines, "\n"));
  const RowMatrix found = motion("warm", full + shapes);
  // The apex of the barrel is half a sample from the nearest one: 0.0025 um.
  EXPECT_LT((found - given).cwiseAbs().maxCoeff(), 0.1 * (far - given).cwiseAbs().maxCoeff());
}

TEST_F(WarmClearanceScene, IsRefusedBesideAClearanceOfItsFileAndWithoutAny) {
  test::expect_parts(refusal("[contact]\nclearance_um = 5\nminimum_warm_clearance_um = 5\n"),
                     {"changed.run.toml:4: contact.minimum_warm_clearance_um: clearance_um and "
                      "minimum_warm_clearance_um exclude each other"});
  const Scene over = scene("[contact]\nminimum_warm_clearance_um = 5\n");
  EXPECT_EQ(over.resolved.find("contact.clearance_um"), std::string::npos) << over.resolved;
  replace_clearance("");
  test::expect_parts(refusal("title = \"neither\"\n"),
                     {"contact.clearance_um: give clearance_um or minimum_warm_clearance_um"});
  test::expect_parts(refusal("[contact]\nminimum_warm_clearance_um = -1\n"),
                     {"contact.minimum_warm_clearance_um: found -1, expected"});
  EXPECT_EQ(refusal("[contact]\nminimum_warm_clearance_um = 5\n"), "accepted");
}

}  // namespace
}  // namespace clatter::dynamics
