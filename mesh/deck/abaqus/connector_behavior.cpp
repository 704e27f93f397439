// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/connector_behavior.hpp"

#include <fmt/format.h>

namespace clatter::mesh::deck::abaqus {
namespace {

void read_elasticity(const Card& card, ConnectorBehavior& behavior, const Source& source) {
  const Keyword& keyword = card.keyword();
  if (const std::string* text = keyword.find("COMPONENT")) {
    const int k = Fields(*text, source, card.origin()).integer(0, "COMPONENT", 1, 6) - 1;
    const auto bit = static_cast<DofMask>(1 << k);
    if (behavior.coupled || ((behavior.elastic | behavior.rigid) & bit) != 0)
      source.fail(card.origin(),
                  fmt::format("{}: component {} has an elasticity already", keyword.name, k + 1));
    if (keyword.has("RIGID")) {
      behavior.rigid = static_cast<DofMask>(behavior.rigid | bit);
      return;
    }
    behavior.stiffness(k, k) = stiffness_of(card, 0, source);
    behavior.elastic = static_cast<DofMask>(behavior.elastic | bit);
    return;
  }
  if (behavior.coupled || (behavior.elastic | behavior.rigid) != 0)
    source.fail(card.origin(),
                fmt::format("{}: its components have an elasticity already", keyword.name));
  std::vector<double> upper;  // D11 D12 D22 D13 ...
  for (size_t i = 0; i < card.size(); ++i) {
    const Fields fields = card.line(i, source);
    for (size_t f = 0; f < fields.size(); ++f) upper.push_back(fields.number(f, "stiffness"));
  }
  if (keyword.has("RIGID") || keyword.has("NONLINEAR") || upper.size() != 21)
    source.fail(card.origin(),
                fmt::format("{}: expected COMPONENT, or the 21 numbers of a coupled linear "
                            "stiffness",
                            keyword.name));
  auto value = upper.begin();
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i <= j; ++i) behavior.stiffness(i, j) = behavior.stiffness(j, i) = *value++;
  behavior.coupled = true;
}

}  // namespace

std::map<std::string, ConnectorBehavior> connector_behaviors(const Model& model) {
  std::map<std::string, ConnectorBehavior> behaviors;
  ConnectorBehavior* open = nullptr;
  for_each_card(model, {"CONNECTORBEHAVIOR", "CONNECTORELASTICITY"}, [&](size_t, const Card& card) {
    const Keyword& keyword = card.keyword();
    if (keyword.key == "CONNECTORBEHAVIOR") {
      open = nullptr;
      keyword.allow({"NAME"}, model.source, model.ignore);
      const auto [at, is_new] =
          behaviors.emplace(folded(keyword.required("NAME", model.source)), ConnectorBehavior());
      if (!is_new) model.source.fail(card.origin(), "found a second behavior of this name");
      open = &at->second;
      return;
    }
    keyword.allow({"COMPONENT", "NONLINEAR", "RIGID"}, model.source, model.ignore);
    if (open == nullptr)
      model.source.fail(
          card.origin(),
          fmt::format("found {}, expected it after *CONNECTOR BEHAVIOR", keyword.name));
    read_elasticity(card, *open, model.source);
  });
  return behaviors;
}

}  // namespace clatter::mesh::deck::abaqus
