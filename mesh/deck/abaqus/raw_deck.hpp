// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The content of a deck: tables of nodes and elements, sets, and the other keywords as cards. A
// flat deck is one scope; a deck of parts has one scope per part and one for the assembly.
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/deck/abaqus/card.hpp"
#include "mesh/deck/abaqus/placement.hpp"
#include "mesh/deck/deck.hpp"
#include "mesh/deck/id_index.hpp"

namespace clatter::mesh::deck::abaqus {

/// Nodes in the order of the deck; three coordinates each.
struct NodeTable {
  std::vector<int32_t> ids;
  std::vector<double> xyz;
  std::vector<Origin> origins;
};

/// Elements of one type name; `nodes` are deck numbers in Abaqus' order.
struct CellTable {
  std::string name;  // "C3D8I"
  CellType type = CellType::kTet4;
  Formulation formulation = Formulation::kDefault;
  std::vector<int32_t> ids;
  std::vector<Origin> origins;
  std::vector<int32_t> nodes;
};

/// Elements of one node (MASS, ROTARYI, DCOUP3D, SPRING1, DASHPOT1) or two (SPRINGA, CONN3D2, ...).
struct PointElement {
  std::string type;
  int32_t id = 0;
  int32_t node = 0;    // number in the deck
  int32_t second = 0;  // the same; 0: none
  Origin origin = 0;
  // Of the node and of `second`: 0, the scope's own, or a number from 1 of Scope::other_instances.
  std::array<int32_t, 2> instance{};
};

/// An element of two dimensions (CPS6, S3) or one (T3D2, B31) beside the solids.
struct ThinElement {
  std::string type;
  std::optional<FaceType> face;  // none for one dimension
  int32_t id = 0;
  Origin origin = 0;
  int32_t count = 0;                           // of its nodes
  std::array<int32_t, kMaxFaceNodes> nodes{};  // numbers in the deck, corners first
};

/// The part of a set from one keyword.
struct SetChunk {
  Origin origin = 0;
  std::string instance;  // of the numbers; empty: the scope's own
  std::vector<int32_t> ids;
  std::vector<std::pair<size_t, Origin>> id_lines;  // first of `ids` on a line, line
  std::vector<IdRange> ranges;
  std::vector<std::pair<std::string, Origin>> names;  // other sets
  std::vector<std::string> elements_of;               // *NSET, ELSET=: nodes of those elements
  int32_t table = 0;                                  // of cells, for rows
  int32_t row_begin = 0, row_end = 0;  // rows of the table that *NODE or *ELEMENT read
};

struct IdSet {
  std::string name;       // as first written
  bool unsorted = false;  // its order counts where sets are paired (*EQUATION, *MPC)
  std::vector<SetChunk> chunks;
};

/// By folded name.
using IdSets = std::map<std::string, IdSet>;

struct Scope {
  std::string name;
  Origin origin = 0;
  NodeTable nodes;
  std::vector<CellTable> cells;
  std::vector<PointElement> points;
  std::vector<ThinElement> thin;
  std::vector<int32_t> ignored_elements;     // numbers of elements that the user ignores
  std::vector<std::string> other_instances;  // names before nodes of `points`: "Bar-1.73"
  IdSets node_sets, element_sets;
  std::vector<Card> cards;
};

/// A positioned part.
struct InstanceLine {
  std::string name, part;
  Origin origin = 0;
  Placement placement;
};

struct RawDeck {
  Scope model;  // the flat deck, or the assembly with materials and steps
  std::vector<Scope> parts;
  std::vector<InstanceLine> instances;
  std::vector<std::string> notes;  // Deck::notes
  std::vector<Damping> damping;    // Deck::damping
  bool marked_shells = false;      // kShellMark
  bool is_calculix = false;        // it has OUTPUT=2D or 3D, which CalculiX alone reads
};

/// The chunk that a new keyword adds to; creates the set if needed.
SetChunk& new_chunk(IdSets& sets, const std::string& name, Origin origin);

}  // namespace clatter::mesh::deck::abaqus
