// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/matrix_market.hpp"

#include <fmt/format.h>

#include "core/base/artefact.hpp"
#include "core/base/matrix_text.hpp"

namespace clatter::condense {

std::vector<std::filesystem::path> matrix_market_files(const std::filesystem::path& path) {
  const auto beside = [&](const char* ending) {
    return std::filesystem::path(path).replace_extension(ending);
  };
  return {beside(".K.mtx"), beside(".M.mtx"), beside(".dofs.tsv")};
}

void export_matrix_market(const ExportedPart& part, const std::filesystem::path& path) {
  const rom::ReducedModel& model = part.model;
  const std::vector<std::filesystem::path> files = matrix_market_files(path);
  const auto &K = files[0], &M = files[1], &map = files[2];
  const std::string rows = fmt::format(
      "{} boundary coordinates, then {} modal ones; row i is line "
      "i of {}",
      model.n_boundary, model.size() - model.n_boundary, map.filename().string());
  const auto head = [&](const char* what) {
    return fmt::format("clatter {}: {} of \"{}\" ({}), {}", version(), what, model.name,
                       model.method, text_of(part.units));
  };
  rom::write_dof_map(map, part.map);
  write_matrix_market(M, model.M_rr, {head("mass"), rows});
  std::vector<std::string> lines{
      head("stiffness"), rows,
      fmt::format("damping D = alpha K + beta M, alpha {} s, beta {} 1/s", model.alpha,
                  model.beta)};
  for (Eigen::Index k = 0; k < model.modal_damping.hz.size(); ++k)
    lines.push_back(fmt::format("and of eigenmodes at {} Hz a ratio of {}, linear between",
                                model.modal_damping.hz[k], model.modal_damping.ratio[k]));
  if (model.loss.rows() > 0) lines.push_back("and of loss factors, which are not in this file");
  write_matrix_market(K, model.K_rr, lines);
}

}  // namespace clatter::condense
