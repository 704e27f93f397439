// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recipe/tables.hpp"

namespace clatter::recipe {

const Keys<Part>& part_keys() {
  static const Keys<Part> keys(
      "part", "a reduced part that stands in this assembly", [](auto& key, Part& part) {
        key.source(part.source);
        key.name("name", part.name, "name of the part").required().distinct();
        key.path("file", part.file, "the part (.rom.h5)").required();
        key.flag("keeps_names", part.keeps_names,
                 "its sets, surfaces and loads keep their names; without it the part's name and _ "
                 "come before: pan_flange");
        key.text("system", part.system,
                 "name of a rectangular [system] with the part's x, y, z; the basic frame without "
                 "it");
        key.choice("mirror", part.mirror,
                   {{"none", Part::Mirror::kNone},
                    {"x", Part::Mirror::kX},
                    {"y", Part::Mirror::kY},
                    {"z", Part::Mirror::kZ}},
                   "direction of the part that is reflected before it is placed");
      });
  return keys;
}

}  // namespace clatter::recipe
