// SPDX-License-Identifier: GPL-3.0-or-later
// [[shell]].
#include "core/recipe/tables.hpp"

namespace clatter::recipe {

namespace {

const Keys<ShellLayer>& shell_layer_keys() {
  static const Keys<ShellLayer> keys(
      "layer", "a layer of a sheet; the first is at the inner side of its faces",
      [](auto& key, ShellLayer& layer) {
        key.source(layer.source);
        key.text("material", layer.material, "name of a [material]").required();
        key.number("thickness", layer.thickness, Range::positive(), "of the layer")
            .required()
            .in_length_unit();
        key.number("angle_deg", layer.angle, Range::between(-360.0, 360.0),
                   "from direction 1 of the sheet to that of the material, right-handed about the "
                   "outward normal");
      });
  return keys;
}

}  // namespace

const Keys<Shell>& shell_keys() {
  static const Keys<Shell> keys(
      "shell", "the section of the shells of some regions", [](auto& key, Shell& shell) {
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
        key.text("system", shell.system,
                 "name of a [system], whose first direction, projected on the sheet, is direction "
                 "1 of orthotropic materials; where the mesh has none of its own");
        key.text("bending_material", shell.bending_material,
                 "name of a [material] that resists bending, if another one does");
        key.text("shear_material", shell.shear_material,
                 "name of a [material] that resists transverse shear, if another one does");
        key.tables("layer", shell.layers, shell_layer_keys())
            .excludes("thickness", "it is that of the layers")
            .excludes("bending", "it is that of the layers")
            .excludes("shear", "it is that of the layers")
            .excludes("bending_material", "the layers resist it")
            .excludes("shear_material", "the layers resist it");
      });
  return keys;
}

}  // namespace clatter::recipe
