// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/effects.hpp"

#include <gtest/gtest.h>

#include "dynamics/component/component_catalogue.hpp"

namespace clatter::dynamics {
namespace {

TEST(Effects, SecondsOfNumberedElementsAddUpInTheirRow) {
  EffectTable table;
  const EffectEntry* entry = find_effect(kComponentEffects, "mounts");
  table.add(entry, "gravity", true, "gravity_m_s2");
  table.add(entry, "friction", false, "contact.friction", "liner");
  table.add(entry, "mounts", true, "[[mount]]", "mount");
  table.add(entry, "oil film", true, "[contact]", "liner");
  EXPECT_TRUE(table.charge("mount 1", 0.25, 10));
  EXPECT_TRUE(table.charge("mount 2", 0.5, 10));
  EXPECT_FALSE(table.charge("mountain", 8.0));
  EXPECT_TRUE(table.charge("liner", 2.0));
  EXPECT_FALSE(table.charge("unknown", 16.0));
  const auto& rows = table.effects();
  EXPECT_EQ(rows[0].seconds, 0.0);
  EXPECT_EQ(rows[1].seconds, 0.0);  // off
  EXPECT_EQ(rows[2].seconds, 0.75);
  EXPECT_EQ(rows[2].evaluations, 20);
  EXPECT_EQ(rows[3].seconds, 2.0);
}

}  // namespace
}  // namespace clatter::dynamics
