// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

const PointElement& coupling_element(Model& model, size_t use, const Card& card) {
  const std::string& set = card.keyword().required("ELSET", model.source);
  const auto& elements = model.sets.elements(use, set, card.origin());
  const PointElement* point =
      elements.size() == 1 ? model.numbering.point(elements.front()) : nullptr;
  if (point == nullptr) {
    model.source.fail(card.origin(), fmt::format("*DISTRIBUTING COUPLING: expected one element "
                                                 "DCOUP3D in {}",
                                                 set));
  }
  return *point;
}

// CalculiX: the reference's displacement is the weighted mean, regardless of the lever arm.
void add_mean_equations(Model& model, const Distributing& distributing) {
  double sum = 0.0;
  for (const auto& term : distributing.terms) {
    sum += term.weight * static_cast<double>(term.node_indices.size());
  }
  for (int k = 0; k < 3; ++k) {
    Equation equation;
    equation.where = distributing.where;
    equation.terms.push_back({distributing.reference, k, 1.0});
    for (const auto& term : distributing.terms) {
      for (const NodeIndex node_index : term.node_indices) {
        equation.terms.push_back({node_index, k, -term.weight / sum});
      }
    }
    model.deck.equations.push_back(std::move(equation));
  }
}

// Distance of the reference from the weighted centre, relative to the radius of the nodes about it.
double lever(const Deck& deck, const Distributing& distributing, const Eigen::Vector3d& reference) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double sum = 0.0, reach = 0.0;
  for (const auto& term : distributing.terms) {
    for (const NodeIndex node_index : term.node_indices) {
      centre += term.weight * deck.mesh.nodes.row(node_index).transpose();
      sum += term.weight;
    }
  }
  centre /= sum;
  for (const auto& term : distributing.terms) {
    for (const NodeIndex node_index : term.node_indices) {
      reach = std::max(reach, (deck.mesh.nodes.row(node_index).transpose() - centre).norm());
    }
  }
  return (reference - centre).norm() / reach;
}

// Element DCOUP3D: its node is the reference; lines "nodes, weight".
void read_distributing_coupling(Model& model, size_t use, const Card& card) {
  card.keyword().allow({"ELSET"}, model.source, model.ignore);
  const PointElement& element = coupling_element(model, use, card);
  Distributing distributing;
  distributing.name = fmt::format("distributing_{}", model.deck.distributing.size() + 1);
  distributing.where = model.source.where(card.origin());
  distributing.reference = model.node_map.require(element.node);
  double sum = 0.0;
  for (size_t i = 0; i < card.size(); ++i) {
    const Fields fields = card.line(i, model.source);
    fields.at_most(2, "nodes, weight");
    Distributing::Term term;
    term.weight = fields.number_or(1, "weight", 1.0);
    if (!(term.weight > 0.0)) fields.fail("expected a weight above 0");
    for (const int32_t row : model.sets.nodes_at(fields, 0, use)) {
      if (model.node_map.mesh_node(row) != NodeMap::kNone) {
        term.node_indices.push_back(model.node_map.mesh_node(row));
      }
    }
    sum += term.weight * static_cast<double>(term.node_indices.size());
    distributing.terms.push_back(std::move(term));
  }
  if (!(sum > 0.0)) model.source.fail(card.origin(), "expected nodes of solids");
  // One thousandth of the radius: coordinates may have few digits.
  if (lever(model.deck, distributing, model.numbering.at(element.node)) > 1e-3) {
    if (model.ignore.skips("MOMENT")) return add_mean_equations(model, distributing);
    model.deck.notes.push_back(fmt::format(
        "{}: node {} of *DISTRIBUTING COUPLING is not at the weighted centre: the moment of its "
        "force is balanced, as in Abaqus; ignore = [\"MOMENT\"] loses it, as CalculiX does",
        model.source.where(card.origin()), model.numbering.node_ids()[element.node]));
  }
  model.deck.distributing.push_back(std::move(distributing));
}

}  // namespace

void build_distributing(Model& model) {
  for_each_card(model, {"DISTRIBUTINGCOUPLING"}, [&](size_t use, const Card& card) {
    read_distributing_coupling(model, use, card);
  });
}

}  // namespace clatter::mesh::deck::abaqus
