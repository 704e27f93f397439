// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The steps of constrain() and their shared data. Relations are gathered and checked first
// (constrainer_relations.cpp), then eliminated (constrain.cpp).
#include <memory>
#include <set>
#include <unordered_map>

#include "assembly/constraint/constrain.hpp"
#include "assembly/constraint/constraint_graph.hpp"
#include "assembly/coupling/member_group.hpp"
#include "assembly/coupling/rigid_coupling.hpp"

namespace clatter::assembly {

class Constrainer {
 public:
  Constrainer(const mesh::Mesh& mesh, const Recipe& recipe, const DofNumbers& numbers,
              SurfaceCache& surfaces);

  Constrained run();

 private:
  /// A distributing coupling onto a [[point]].
  struct Onto {
    Coupling coupling;
    std::vector<int32_t> ids;
    std::string where;
  };

  // Relations.
  void gather_supports();
  void gather_node_sets();
  void gather_couplings();
  void gather_equations();
  void gather_springs();
  void note_grounded(const std::vector<EquationSpec::Term>& terms);
  void gather_straight_edges();
  void gather_ties();
  void add_tie(const TieSpec& spec, int32_t jump);
  void add_rigid(const CouplingSpec& spec);
  void note_rigid(const CouplingSpec& spec, NodeOrPoint owner, int32_t reference);
  void add_onto_point(const CouplingSpec& spec);
  void depend(int32_t dof, Functional on, int relation);
  Functional term(const EquationSpec::Term& term) const;
  std::vector<Member> members(const CouplingSpec& spec);
  ReferenceDofs point_dofs(int32_t point) const;
  int32_t point_named(const std::string& name) const;
  Eigen::Vector3d own_position(const CouplingSpec& spec, const std::vector<Member>& members);

  // Elimination.
  void start_elimination();
  void hold_oblique(bool points);
  void couple_onto_points();
  void add_generalised_sets();
  void add_generalised(const std::string& name, const Coupling& coupling, const std::string& where);
  void append_motion(const std::vector<Functional>& functionals);
  void drop_unattached();
  void drop_unattached(const std::string& name, const std::string& where,
                       const ReferenceDofs& reference, const std::vector<bool>& moves,
                       const std::vector<bool>& massive);
  std::vector<bool> massive_ids();
  void number_sets();
  void number_node_sets();
  void finish();

  const mesh::Mesh& mesh_;
  const Recipe& recipe_;
  const DofNumbers& numbers_;
  SurfaceCache& surfaces_;
  Constrained out_;
  ConstraintGraph graph_;
  std::unordered_map<int32_t, Functional> dependences_;
  std::vector<HeldGroup> supports_;
  std::unordered_map<int32_t, HeldDof> held_of_;  // by id of the supported coordinate
  std::vector<std::vector<int32_t>> set_nodes_;   // like recipe_.nodes
  std::vector<int32_t> kept_;
  std::vector<Onto> onto_;
  std::map<std::string, ReferenceDofs> own_references_;  // of rigid couplings, by set
  int32_t next_own_ = 0;                                 // first id of the next rigid coupling
  std::vector<Eigen::RowVectorXd> motion_;               // of generalised ids
  std::vector<Eigen::RowVectorXd> grounded_;             // rows of Constrained::grounded
  std::unique_ptr<Eliminator> eliminator_;
};

}  // namespace clatter::assembly
