// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Export of mode shapes and static results to ParaView.
#include <filesystem>
#include <vector>

namespace clatter::modal {

/// InputError for an extension that export_results() does not support; call before the work.
void check_result_exports(const std::vector<std::filesystem::path>& exports);

/// Writes the results of a .modes.h5 or .static.h5 to each of `exports`:
///  .vtu  all results on one mesh: point data "mode 07 84.31 Hz" (n x 3, unit modal mass
///        [1/sqrt(kg)]), or by case "CASE displacement" (n x 3) [m], "CASE stress" (n x 6: xx yy zz
///        xy yz zx) and "CASE von Mises" [Pa]. Several regions have separate stresses, "CASE
///        stress REGION", NaN outside the region.
///  .pvd  a series: one .vtu per mode or case in the same folder, with point data "displacement"
///        (and "stress", "von Mises"), time = number of the mode or case; holds one at a time
/// Cells, regions and node numbers come from `cells` (.fe.h5 or .mesh.h5); without it the surface
/// "skin" is used. InputError for other extensions, for a file that holds no results and for cells
/// of other nodes; FileError on disk errors.
void export_results(const std::filesystem::path& results, const std::filesystem::path& cells,
                    const std::vector<std::filesystem::path>& exports);

}  // namespace clatter::modal
