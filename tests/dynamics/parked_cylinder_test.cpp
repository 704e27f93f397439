// SPDX-License-Identifier: GPL-3.0-or-later
// An engine whose pistons are all disconnected but one is that with this one cylinder.
#include <gtest/gtest.h>

#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic.hpp"

namespace clatter::dynamics {
namespace {

class ParkedCylinders : public testing::SlapScenes {
 protected:
  void SetUp() override {
    testing::SlapScenes::SetUp();
    testing::write_rom(folder_ / "block.rom.h5", testing::four_bore_block(0.0535, 4, 3));
  }
  /// The third of four in-line cylinders, and the others as `parked` says.
  static std::string engine(bool with_others, const std::string& parked) {
    std::string text = "[time]\ncycles = 1\n" + testing::dry_engine(1e4);
    for (int k = 1; k <= 4; ++k)
      if (k == 3 || with_others) text += testing::in_line_cylinder(k, k == 3 ? "" : parked);
    return text;
  }
};

TEST_F(ParkedCylinders, LeaveTheOneThatRunsAloneToTheBit) {
  const H5File one = recorded(scene(engine(false, "")), "one");
  const H5File four = recorded(scene(engine(true, "parked = true\n")), "four");
  ASSERT_EQ(one.list("bodies"), four.list("bodies"));
  for (const std::string& body : one.list("bodies"))
    for (const char* what : {"q", "v", "a"}) {
      const std::string name = "bodies/" + body + "/" + what;
      EXPECT_EQ(one.read_rows(name), four.read_rows(name)) << name;
    }
  ASSERT_EQ(one.list("history"), four.list("history"));
  for (const std::string& name : one.list("history"))
    EXPECT_EQ(one.read_doubles("history/" + name), four.read_doubles("history/" + name)) << name;
  EXPECT_EQ(one.read_doubles("energy/imbalance"), four.read_doubles("energy/imbalance"));
  EXPECT_GT(one.read_rows("bodies/c3_piston/v").cwiseAbs().maxCoeff(), 0.01);
  std::string effects;
  for (const auto& line : result_.model->effects.lines(false)) effects += line + "\n";
  EXPECT_NE(effects.find("c1: piston and rod"), std::string::npos) << effects;
}

TEST_F(ParkedCylinders, AreAsManyAsLeaveOne) {
  EXPECT_EQ(refusal(engine(true, "parked = true\n")), "accepted");
  EXPECT_NE(refusal("[[cylinder]]\nname = \"a\"\nparked = true\n")
                .find("cylinder: found all of them parked, expected one that is not"),
            std::string::npos)
      << refusal("[[cylinder]]\nname = \"a\"\nparked = true\n");
  EXPECT_NE(refusal("[[cylinder]]\nname = \"a\"\nparked = 1\n").find("cylinder[0].parked"),
            std::string::npos);
  // Its tables are read like those of the others.
  EXPECT_NE(refusal("[[cylinder]]\nname = \"a\"\n[[cylinder]]\nname = \"b\"\nparked = true\n"
                    "[cylinder.rod]\nmass_kg = -1\n")
                .find("cylinder[1].rod.mass_kg: found -1"),
            std::string::npos);
}

}  // namespace
}  // namespace clatter::dynamics
