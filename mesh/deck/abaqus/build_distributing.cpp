// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "mesh/deck/abaqus/reading.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

const PointElement& coupling_element(Reading* reading, size_t use, const Card& card) {
  const std::string& set = card.keyword().required("ELSET", reading->source);
  const auto& elements = reading->sets->elements(use, set, card.spot());
  const int32_t n_cells = reading->model->cells();
  if (elements.size() != 1 || elements.front() < n_cells) {
    reading->source.fail(card.spot(), fmt::format("*DISTRIBUTING COUPLING: expected one element "
                                                  "DCOUP3D in {}",
                                                  set));
  }
  return reading->model->points()[static_cast<size_t>(elements.front() - n_cells)];
}

// CalculiX: the reference's displacement is the weighted mean, regardless of the lever arm.
void add_mean_equations(Reading* reading, const Distributing& distributing) {
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
    reading->deck->equations.push_back(std::move(equation));
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
void read_distributing_coupling(Reading* reading, size_t use, const Card& card) {
  card.keyword().allow({"ELSET"}, reading->source, reading->ignore);
  const PointElement& element = coupling_element(reading, use, card);
  Distributing distributing;
  distributing.name = fmt::format("distributing_{}", reading->deck->distributing.size() + 1);
  distributing.where = reading->source.where(card.spot());
  distributing.reference = reading->node_map->of(element.node);
  double sum = 0.0;
  for (size_t i = 0; i < card.size(); ++i) {
    const Fields fields = card.line(i, reading->source);
    fields.at_most(2, "nodes, weight");
    Distributing::Term term;
    term.weight = fields.number_or(1, 1.0, "weight");
    if (!(term.weight > 0.0)) fields.fail("expected a weight above 0");
    for (const int32_t row : reading->sets->nodes_at(fields, 0, use)) {
      if (reading->node_map->mesh_node(row) != NodeMap::kNone) {
        term.node_indices.push_back(reading->node_map->mesh_node(row));
      }
    }
    sum += term.weight * static_cast<double>(term.node_indices.size());
    distributing.terms.push_back(std::move(term));
  }
  if (!(sum > 0.0)) reading->source.fail(card.spot(), "expected nodes of solids");
  // One thousandth of the radius: coordinates may have few digits.
  if (lever(*reading->deck, distributing, reading->model->at(element.node)) <= 1e-3) {
    reading->deck->distributing.push_back(std::move(distributing));
  } else if (reading->ignore->skips("MOMENT")) {
    add_mean_equations(reading, distributing);
  } else {
    reading->source.fail(
        card.spot(), fmt::format("node {} of *DISTRIBUTING COUPLING is not at the weighted centre: "
                                 "Abaqus balances the moment of its force, CalculiX does not; "
                                 "ignore = [\"MOMENT\"] reads it as CalculiX does",
                                 reading->model->node_ids()[static_cast<size_t>(element.node)]));
  }
}

}  // namespace

void read_distributing(Reading* reading) {
  for_each_card(*reading, {"DISTRIBUTINGCOUPLING"}, [&](size_t use, const Card& card) {
    read_distributing_coupling(reading, use, card);
  });
}

}  // namespace clatter::mesh::deck::abaqus
