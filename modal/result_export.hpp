#pragma once
// Mode shapes and static results for ParaView.
#include <filesystem>
#include <vector>

namespace clatter::modal {

/// Is it a file of results (.modes.h5, .static.h5) by its schema? False for what is not readable.
bool is_results(const std::filesystem::path& path);

/// InputError for an extension that export_results() does not know: before the work.
void check_result_exports(const std::vector<std::filesystem::path>& exports);

/// Writes the results of a .modes.h5 or .static.h5 to each of `exports`:
///  .vtu  all of them on one mesh: point data "mode 07 84.31 Hz" (n x 3, unit modal mass
///        [1/sqrt(kg)]), or by case "CASE displacement" (n x 3) [m], "CASE stress" (n x 6: xx yy zz
///        xy yz zx) and "CASE von Mises" [Pa]. Several regions have stresses of their own, "CASE
///        stress REGION", not a number off the region.
///  .pvd  a series: one .vtu a mode or case beside it, with point data "displacement" (and
///  "stress",
///        "von Mises"), time being the mode's or case's number; needs memory for one only
/// Cells, regions and numbers come from `cells` (.fe.h5 or .mesh.h5); without it the surface "skin"
/// is drawn. InputError for other extensions and for cells of other nodes; FileError for the disk.
void export_results(const std::filesystem::path& results, const std::filesystem::path& cells,
                    const std::vector<std::filesystem::path>& exports);

}  // namespace clatter::modal
