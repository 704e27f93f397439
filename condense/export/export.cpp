#include "condense/export/export.hpp"

#include <fmt/format.h>

#include "condense/export/calculix.hpp"
#include "condense/export/dmig.hpp"
#include "condense/export/matrix_market.hpp"
#include "condense/export/mbdyn.hpp"
#include "core/error.hpp"

namespace clatter::condense {

std::vector<std::filesystem::path> export_reduced(const ReducedModel& model,
                                                  const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (model.combined.rows() > 0)
    throw InputError(fmt::format(
        "{}: found {} boundary coordinates that became interface modes, expected a part "
        "without [interface] for other programs",
        model.name, model.combined.rows()));
  if (extension == ".mtx") return export_matrix_market(model, path);
  if (extension == ".inp") return export_calculix(model, path);
  if (extension == ".pch") return export_dmig(model, path);
  if (extension == ".fem") return export_mbdyn(model, path);
  throw InputError(fmt::format(
      "{}: found extension \"{}\", expected .mtx (Matrix Market), .inp (CalculiX), .pch "
      "(Nastran) or .fem (MBDyn)",
      path.string(), extension));
}

}  // namespace clatter::condense
