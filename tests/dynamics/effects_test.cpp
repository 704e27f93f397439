// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/effects.hpp"

#include <gtest/gtest.h>

namespace clatter::dynamics {
namespace {

TEST(Effects, SecondsOfNumberedElementsAddUpInTheirRow) {
  EffectTable table;
  table.add("gravity", true, "gravity_m_s2");
  table.add("friction", false, "contact.friction", "liner");
  table.add("mounts", true, "[[mount]]", "mount");
  table.add("oil film", true, "[contact]", "liner");
  table.charge("mount 1", 0.25);
  table.charge("mount 2", 0.5);
  table.charge("mountain", 8.0);
  table.charge("liner", 2.0);
  table.charge("unknown", 16.0);
  const auto& rows = table.effects();
  EXPECT_EQ(rows[0].seconds, 0.0);
  EXPECT_EQ(rows[1].seconds, 0.0);  // off
  EXPECT_EQ(rows[2].seconds, 0.75);
  EXPECT_EQ(rows[3].seconds, 2.0);
}

}  // namespace
}  // namespace clatter::dynamics
