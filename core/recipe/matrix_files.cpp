// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recipe/tables.hpp"

namespace clatter::recipe {

const keys::Keys<MatrixFiles>& matrix_files_keys() {
  static const keys::Keys<MatrixFiles> keys(
      "matrices", "matrices that another program assembled, instead of all other tables",
      [](auto& key, MatrixFiles& files) {
        key.path("K", files.K, "stiffness: Matrix Market, or lines \"i j value\" as Abaqus writes")
            .required();
        key.path("M", files.M, "mass, likewise").required();
        key.path("dofs", files.dofs,
                 "meaning of each row (docs/formats.md); x y z of the mesh's nodes without it");
        key.text("name", files.name, "name of the part; that of the mesh without it");
        key.units("units", files.units, "units of K and M");
        key.number("alpha", files.alpha, Range::not_negative(),
                   "factor alpha of the stiffness in the damping D = alpha K + beta M")
            .shown_in("s");
        key.number("beta", files.beta, Range::not_negative(), "factor beta of the mass")
            .shown_in("1/s");
      });
  return keys;
}

}  // namespace clatter::recipe
