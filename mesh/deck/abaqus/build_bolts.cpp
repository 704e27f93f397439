// SPDX-License-Identifier: GPL-3.0-or-later
// *PRE-TENSION SECTION: a cut through the shank of a bolt, whose sides overlap by what tightens it.
//
// u_near - u_far = d n: d, the displacement 1 of the reference node, its force the tension along n.
// As in CalculiX 2.20: near is the side of the surface's elements, n by default the outward normal
// of the surface, and nodes of the cut stay on the far side, so that supports and loads act there.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr const char* kName = "*PRE-TENSION SECTION";

/// Vector area of the faces by their corners, outward.
Eigen::Vector3d vector_area(const Numbering& numbering, const std::vector<CellFaceId>& faces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const CellFaceId& id : faces) {
    const FaceRows face = face_rows(numbering, id);
    const Eigen::Vector3d first = numbering.at(face.rows[0]);
    for (size_t i = 1; i + 1 < face.corners; ++i)
      sum += (numbering.at(face.rows[i]) - first).cross(numbering.at(face.rows[i + 1]) - first) / 2;
  }
  return sum;
}

Eigen::Vector3d direction_of(const Model& model, const Card& card, const BoltCut& cut) {
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  if (card.size() == 0) {
    n = vector_area(model.numbering, cut.near);
  } else {
    const Fields fields = card.line(0, model.source);
    fields.at_most(3, "the direction of the bolt");
    for (size_t d = 0; d < 3; ++d)
      n(static_cast<int>(d)) = fields.number_or(d, "direction of the bolt", 0.0);
  }
  if (!(n.norm() > 0.0))
    model.source.fail(card.origin(), fmt::format("{}: expected a direction of the bolt", kName));
  return n.normalized();
}

/// Appends a copy of each node of the cut and gives it to the cells of its near side.
void copy_nodes(Model& model, const BoltCut& cut) {
  Mesh& mesh = model.deck.mesh;
  const std::vector<int32_t>& ids = model.numbering.node_ids();
  const int32_t highest = std::max(*std::max_element(ids.begin(), ids.end()),
                                   *std::max_element(mesh.node_ids.begin(), mesh.node_ids.end()));
  const auto count = static_cast<Eigen::Index>(cut.rows.size());
  const Eigen::Index first = mesh.nodes.rows();
  if (std::numeric_limits<int32_t>::max() - highest < count)
    model.source.fail(cut.origin, fmt::format("{}: found no free numbers for its nodes", kName));
  mesh.nodes.conservativeResize(first + count, Eigen::NoChange);
  for (Eigen::Index i = 0; i < count; ++i) {
    mesh.nodes.row(first + i) = model.numbering.at(cut.rows[i]);
    mesh.node_ids.push_back(highest + 1 + static_cast<int32_t>(i));
  }
  for (const int32_t cell : cut.cells) {
    for (const int32_t row : model.numbering.nodes_of(cell)) {
      const auto at = std::lower_bound(cut.rows.begin(), cut.rows.end(), row);
      if (at != cut.rows.end() && *at == row)
        model.node_map.set_copy(cell, row, static_cast<int32_t>(first + (at - cut.rows.begin())));
    }
  }
}

}  // namespace

void cut_bolts(Model& model) {
  for_each_card(model, {"PRE-TENSIONSECTION"}, [&](size_t use, const Card& card) {
    const Keyword& keyword = card.keyword();
    keyword.allow({"SURFACE", "NODE"}, model.source, model.ignore);
    BoltCut cut =
        cut_along(model.numbering,
                  faces_named(model, use, keyword.required("SURFACE", model.source), card.origin()),
                  use, card.origin());
    for (const BoltCut& other : model.cuts) {
      std::vector<int32_t> common;
      std::set_intersection(cut.rows.begin(), cut.rows.end(), other.rows.begin(), other.rows.end(),
                            std::back_inserter(common));
      if (!common.empty())
        model.source.fail(card.origin(), fmt::format("{}: found node {} in two cuts, expected one",
                                                     kName, model.numbering.node_ids()[common[0]]));
    }
    copy_nodes(model, cut);
    model.cuts.push_back(std::move(cut));
  });
}

void build_bolts(Model& model) {
  for_each_card(model, {"PRE-TENSIONSECTION"}, [&](size_t use, const Card& card) {
    const auto cut = std::find_if(model.cuts.begin(), model.cuts.end(), [&](const BoltCut& one) {
      return one.origin == card.origin() && one.use == use;
    });
    if (cut == model.cuts.end()) throw FollowUp();
    const Keyword& keyword = card.keyword();
    const std::string& name = keyword.required("SURFACE", model.source);
    const int32_t row =
        model.sets.node_named(keyword.required("NODE", model.source), use, card.origin());
    if (model.node_map.find(row) != NodeMap::kNone)
      model.source.fail(card.origin(),
                        fmt::format("{}: found reference node {}, which has another use, expected "
                                    "one of no element",
                                    kName, model.numbering.node_ids()[row]));
    Bolt bolt;
    bolt.where = model.source.where(card.origin());
    bolt.reference = model.node_map.require(row);
    model.deck.points.back().of_bolt = true;
    bolt.slave = surface_named(model, use, name, card.origin());
    bolt.master = add_surface(model, bolt.slave + "_other_side", cut->far);
    bolt.direction = direction_of(model, card, *cut);
    model.deck.bolts.push_back(std::move(bolt));
  });
}

void finish_bolts(Model& model) {
  Deck& deck = model.deck;
  const auto bolt_at = [&](NodeIndex node_index) {
    return std::find_if(deck.bolts.begin(), deck.bolts.end(),
                        [&](const Bolt& bolt) { return bolt.reference == node_index; });
  };
  const auto refuse = [&](NodeIndex node_index, const std::string& where, const char* found) {
    if (bolt_at(node_index) == deck.bolts.end()) return;
    model.refusals.add(
        fmt::format("{}: found {} of the reference node of {} ({}), expected only "
                    "its force, *CLOAD along 1",
                    where, found, kName, bolt_at(node_index)->where));
  };
  const auto refuse_held = [&](const std::vector<Support>& supports) {
    for (const Support& support : supports)
      for (const NodeIndex node_index : support.node_indices)
        refuse(node_index, support.where, "a support");
  };
  refuse_held(deck.supports);
  refuse_held(deck.retained);
  for (const Step& step : deck.steps) {
    refuse_held(step.supports);
    for (const Step::NodalForce& force : step.forces)
      if (force.direction != 0) refuse(force.node_index, step.where, "another direction");
  }
  for (const Rigid& rigid : deck.rigid) refuse(rigid.reference, rigid.where, "a rigid body");
  for (const Distributing& one : deck.distributing) refuse(one.reference, one.where, "a coupling");
  for (const Equation& equation : deck.equations)
    for (const Equation::Term& term : equation.terms)
      refuse(term.node_index, equation.where, "an equation");
  for (const Spring& spring : deck.springs)
    for (const Equation::Term& term : spring.terms)
      refuse(term.node_index, spring.where, "a spring");
  for (const Mass& mass : deck.masses) refuse(mass.node_index, mass.where, "a mass");
  for (auto& [name, field] : deck.mesh.fields) {
    for (const BoltCut& cut : model.cuts)
      for (const int32_t cell : cut.cells)
        for (const int32_t row : model.numbering.nodes_of(cell))
          field.row(model.node_map.mesh_node_of(cell, row)) =
              field.row(model.node_map.mesh_node(row));
  }
}

}  // namespace clatter::mesh::deck::abaqus
