// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/static_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "modal/gasket_statics.hpp"

namespace clatter::modal {
namespace {

std::string supports_of(const fe::FeModel& model, const StaticCase& solved) {
  std::vector<std::string> members;
  for (Eigen::Index s = 0; s < solved.support_sums.rows(); ++s) {
    std::vector<std::string> sums;
    for (const double value : solved.support_sums.row(s)) sums.push_back(json_number(value));
    members.push_back(
        fmt::format("{}: [{}]", json_text(model.supports.names[s]), fmt::join(sums, ", ")));
  }
  return fmt::format("{{{}}}", fmt::join(members, ", "));
}

std::string gaskets_of(const fe::FeModel& model, const StaticCase& solved) {
  std::vector<std::string> members;
  for (size_t g = 0; g < solved.gaskets.size(); ++g) {
    const GasketSums sums = sums_of(model.gaskets[g], solved.gaskets[g]);
    members.push_back(fmt::format(
        "{}: {{\"area_m2\": {}, \"pressed_m2\": {}, \"force_n\": {}, "
        "\"highest_pressure_pa\": {}, \"opening_m\": {}}}",
        json_text(model.gaskets[g].name), json_number(sums.area), json_number(sums.pressed),
        json_number(sums.force), json_number(sums.highest), json_number(sums.opening)));
  }
  return fmt::format("{{{}}}", fmt::join(members, ", "));
}

}  // namespace

JsonMembers json_of(const fe::FeModel& model, const StaticSolution& solution) {
  std::vector<std::string> cases;
  for (const StaticCase& one : solution.cases) {
    double largest = 0.0;
    for (Eigen::Index a = 0; a < model.nodes.rows(); ++a)
      largest = std::max(largest, one.displacement.segment<3>(3 * a).norm());
    const double stress = one.stress.empty() ? std::nan("") : largest_stress(one).von_mises;
    cases.push_back(fmt::format(
        "{{\"name\": {}, \"largest_displacement_m\": {}, \"energy_j\": {}, "
        "\"backward_error\": {}, \"forward_error\": {}, "
        "\"balance\": {}, \"largest_von_mises_pa\": {}, \"supports\": {}, \"gaskets\": {}}}",
        json_text(one.name), json_number(largest), json_number(one.energy),
        json_number(one.backward_error), json_number(one.forward_error), json_number(one.balance),
        json_number(stress), supports_of(model, one), gaskets_of(model, one)));
  }
  return {{"cases", json_number(static_cast<double>(solution.cases.size()))},
          {"results", fmt::format("[{}]", fmt::join(cases, ", "))}};
}

}  // namespace clatter::modal
