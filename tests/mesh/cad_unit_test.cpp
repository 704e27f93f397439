// SPDX-License-Identifier: GPL-3.0-or-later
// The unit of a CAD file; the default description for a CAD file alone.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/config.hpp"
#include "core/base/error.hpp"
#include "iges_box.hpp"
#include "mesh/geometry/bare_cad.hpp"
#include "mesh/geometry/cad_unit.hpp"
#include "support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using testing::Folder;

std::string unit_of(const std::string& name, const std::string& text) {
  const Folder folder;
  std::ofstream(folder / name) << text;
  return cad_unit(folder / name);
}

TEST(CadUnit, StepNamesItsUnitAlsoOverSeveralLines) {
  EXPECT_EQ(unit_of("a.step",
                    "#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
                    "#2=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));"),
            "mm");
  EXPECT_EQ(unit_of("a.STP", "#1=( LENGTH_UNIT ( )\n NAMED_UNIT ( * )\n SI_UNIT ( $, .METRE. ) );"),
            "m");
  EXPECT_EQ(unit_of("a.stp",
                    "#3=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
                    "#4=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#3);\n"
                    "#5=(CONVERSION_BASED_UNIT('INCH',#4)LENGTH_UNIT()NAMED_UNIT(#6));"),
            "inch");
  EXPECT_EQ(unit_of("a.step", "ISO-10303-21;"), "");
}

TEST(CadUnit, IgesHasItInItsGlobalSectionAndBrepNever) {
  const std::string box = testing::iges_box({10, 20, 30});
  EXPECT_EQ(unit_of("a.igs", box), "mm");
  std::string inches = box;
  inches.replace(inches.find(",1.,2,2HMM"), 10, ",1.,1,2HIN");
  EXPECT_EQ(unit_of("a.iges", inches), "inch");
  EXPECT_EQ(unit_of("a.brep", "DBRep_DrawableShape"), "");
  test::expect_parts(test::refusal_of([&] { cad_unit("none.step"); }),
                     {"none.step: file not found"});
}

TEST(BareCad, TheDescriptionNamesTheFileFromItsOwnFolder) {
  const Folder folder;
  std::filesystem::create_directories(folder / "out");
  std::ofstream(folder / "my \"part\".brep") << "";
  EXPECT_EQ(description_beside(folder / "out/b.mesh.h5"), folder / "out/b.mesh.toml");
  EXPECT_EQ(description_beside(folder / "out/b.h5"), folder / "out/b.mesh.toml");
  const std::filesystem::path description = folder / "out/b.mesh.toml";
  const std::string text = cad_description(folder / "my \"part\".brep", description, 2.5);
  keep_description(description, text);
  const Config config = Config::load(description);
  EXPECT_EQ(config.text("name"), "my \"part\"");
  EXPECT_EQ(config.table("mesh").number("element_size_mm"), 2.5);
  EXPECT_TRUE(std::filesystem::exists(config.table("cad").path("source")));
  keep_description(description, "other");
  EXPECT_EQ(Config::load(description).text("kind"), "cad");
}

}  // namespace
}  // namespace clatter::mesh
