#include "core/modes/factor_trouble.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/fe/dof_place.hpp"
#include "core/fe/free_motions.hpp"

namespace clatter::modes {
namespace {

std::string body_of(const std::vector<int>& body, int32_t dof) {
  const int own = body[static_cast<size_t>(dof)];
  const int bodies = 1 + *std::max_element(body.begin(), body.end());
  if (bodies == 1) return {};
  return fmt::format(" in body {} of {} ({} unknowns)", own + 1, bodies,
                     std::count(body.begin(), body.end(), own));
}

/// Motions of the body that holds `dof`, or of any body, that nothing holds.
std::string loose_motions(const fe::FeModel& model, const std::vector<int>& body, int32_t dof) {
  const fe::FreeMotions free = fe::free_motions(model);
  std::vector<std::string> names;
  for (Eigen::Index c = 0; c < free.count(); ++c) {
    if (dof >= 0 && free.body[static_cast<size_t>(c)] != body[static_cast<size_t>(dof)]) continue;
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
  const int32_t dof = error.column < 0 ? -1 : left[static_cast<size_t>(error.column)];
  const std::vector<int> body = fe::bodies_of(model.K, model.M);
  std::string text = fmt::format("{}: {}: {}", model.name, matrix, error.what());
  if (dof >= 0) text += ", at " + fe::place_of(model, dof) + body_of(body, dof);
  const bool stiff = dof < 0 || model.K.coeff(dof, dof) > 0.0;
  const bool heavy = dof < 0 || model.M.coeff(dof, dof) > 0.0;
  const std::string loose = loose_motions(model, body, dof);
  if (!stiff)
    text += fmt::format(
        ": it has no stiffness{}: a node that no cell or spring uses, or that a "
        "damper alone holds",
        heavy ? "" : " and no mass");
  else if (!loose.empty())
    text += ": nothing holds its " + loose + ": add a [[support]], or a [[tie]] to what holds it";
  else
    text +=
        ": supports hold all rigid motions, so this is a mechanism: couplings or equations that "
        "work as a hinge, a part that is joined at too few nodes, or matrices that are not of one "
        "body";
  return {text, error.column};
}

}  // namespace clatter::modes
