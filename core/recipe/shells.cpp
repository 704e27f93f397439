// SPDX-License-Identifier: GPL-3.0-or-later
// [[shell]].
#include "core/recipe/tables.hpp"

namespace clatter::recipe {

const Keys<Shell>& shell_keys() {
  static const Keys<Shell> keys(
      "shell", "the thickness of the shells of some regions", [](auto& key, Shell& shell) {
        fe::ShellSection& section = shell.section;
        key.source(shell.source);
        key.texts("regions", shell.regions, "regions of the mesh that are shells").required();
        key.number("thickness", section.thickness, Range::not_negative(),
                   "of the sheet; needed where the mesh has none of its own")
            .in_length_unit();
        key.number("offset", section.offset, {},
                   "from the nodes to the middle of the sheet, towards the outward side of its "
                   "faces; where the mesh has none of its own")
            .in_length_unit();
        key.number("bending", section.bending, Range::positive(),
                   "bending stiffness over that of a solid sheet, 12 I / t^3");
        key.number("shear", section.shear, Range::positive(),
                   "k of the stiffness k G t against transverse shear");
        key.number("area_mass", section.area_mass, Range::not_negative(),
                   "mass per area beside that of the material")
            .shown_in("kg/m2");
      });
  return keys;
}

}  // namespace clatter::recipe
