// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/modes/factor_failure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/fe/dof_label.hpp"
#include "core/fe/free_motions.hpp"

namespace clatter::modes {
namespace {

std::string body_of(const std::vector<int>& body, int32_t dof) {
  const int own = body[dof];
  const int bodies = 1 + *std::max_element(body.begin(), body.end());
  if (bodies == 1) return {};
  return fmt::format(" in body {} of {} ({} unknowns)", own + 1, bodies,
                     std::count(body.begin(), body.end(), own));
}

/// Unsupported motions of the body of `dof`, or of any body.
std::string loose_motions(const fe::FeModel& model, const std::vector<int>& body, int32_t dof) {
  const fe::FreeMotions free = fe::free_motions(model);
  std::vector<std::string> names;
  for (Eigen::Index c = 0; c < free.count(); ++c) {
    if (dof >= 0 && free.body[c] != body[dof]) continue;
    std::string name = fe::motion_name(free.unit.col(c), fe::characteristic_length(model));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

sparse::NotPositiveDefinite explained(const fe::FeModel& model, const std::string& matrix,
                                      const std::vector<int32_t>& left,
                                      const sparse::NotPositiveDefinite& error) {
  const int32_t dof = error.column < 0 ? -1 : left[error.column];
  const std::vector<int> body = fe::bodies_of(model.K, model.M);
  std::string text = fmt::format("{}: {}: {}", model.name, matrix, error.what());
  if (dof >= 0) text += ", at " + fe::describe_dof(model, dof) + body_of(body, dof);
  const bool stiff = dof < 0 || model.K.coeff(dof, dof) > 0.0;
  const bool heavy = dof < 0 || model.M.coeff(dof, dof) > 0.0;
  const std::string loose = loose_motions(model, body, dof);
  if (!stiff)
    text += fmt::format(
        ": it has no stiffness{}: a node without cells or springs, or with only a damper",
        heavy ? "" : " and no mass");
  else if (!loose.empty())
    text += ": unsupported " + loose + ": add a [[support]], or a [[tie]] to a supported part";
  else
    text +=
        ": all rigid-body motions are supported, so this is a mechanism: couplings or "
        "equations that act as a hinge, a part connected at too few nodes, or matrices of "
        "different models";
  return {text, error.column};
}

}  // namespace clatter::modes
