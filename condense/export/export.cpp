// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/export.hpp"

#include <fmt/format.h>

#include "condense/export/calculix.hpp"
#include "condense/export/dmig.hpp"
#include "condense/export/matrix_market.hpp"
#include "condense/export/mbdyn.hpp"
#include "core/base/error.hpp"

namespace clatter::condense {

namespace {

/// Without the sets that are no coordinates: other programs have no rows for them.
rom::ReducedModel coordinates_only(rom::ReducedModel model) {
  Eigen::Index rows = 0;
  for (const std::string& name : model.recovered_sets) {
    for (const int32_t dof : model.set(name).dofs) rows += dof >= model.size() ? 1 : 0;
    model.sets.erase(name);
    model.grids.erase(name);
  }
  model.recovered_sets.clear();
  model.combined.conservativeResize(model.combined.rows() - rows, Eigen::NoChange);
  return model;
}

}  // namespace

std::vector<std::filesystem::path> exported_files(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".mtx") return matrix_market_files(path);
  if (extension == ".inp") return calculix_files(path);
  if (extension == ".pch" || extension == ".fem") return {path};
  throw InputError(fmt::format(
      "{}: found extension \"{}\", expected .mtx (Matrix Market), .inp (CalculiX), .pch "
      "(Nastran) or .fem (MBDyn)",
      path.string(), extension));
}

std::vector<std::filesystem::path> export_reduced(const rom::ReducedModel& with_rows,
                                                  const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  const rom::ReducedModel model = coordinates_only(with_rows);
  if (model.combined.rows() > 0)
    throw InputError(fmt::format(
        "{}: found {} boundary coordinates that became interface modes, expected a part "
        "without [interface] for other programs",
        model.name, model.combined.rows()));
  if (extension == ".mtx") return export_matrix_market(model, path);
  if (extension == ".inp") return export_calculix(model, path);
  if (extension == ".pch") return export_dmig(model, path);
  if (extension == ".fem") return export_mbdyn(model, path);
  return exported_files(path);  // throws
}

}  // namespace clatter::condense
