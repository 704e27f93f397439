// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The bulk data as written: numbers, units and coordinate systems of the deck.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesh/deck/chunked.hpp"
#include "mesh/deck/nastran/card.hpp"
#include "mesh/deck/nastran/control.hpp"

namespace clatter::mesh::deck::nastran {

/// Values of a GRID field with a default in GRDSET while cards are read: blank, or an explicit
/// zero.
inline constexpr int32_t kBlank = 0, kZero = -2;
inline constexpr int32_t kNoRow = -1;  // of a mid-side node that the card omits
inline constexpr DofMask kNoneHeld = 0x80;

/// GRID cards, as columns. Columns that no card uses so far are empty or short (column_at).
struct Grids {
  std::vector<int32_t> ids;
  Chunked<std::array<double, 3>> at;  // in the system of cp
  std::vector<Origin> origins;
  std::vector<int32_t> cp, cd;  // systems of coordinates and of displacements
  std::vector<DofMask> held;    // permanent constraints

  size_t size() const { return ids.size(); }
};

/// The i-th of a column that may be empty or short.
template <class T>
T column_at(const std::vector<T>& column, size_t i) {
  return i < column.size() ? column[i] : T{};
}

/// GRDSET: what blank fields of GRID mean.
struct GridDefaults {
  int32_t cp = 0, cd = 0;
  DofMask held = 0;
};

/// Cells of one type and property.
struct RawBlock {
  CellType type = CellType::kTet4;
  int32_t property = 0;
  std::vector<int32_t> ids;
  Chunked<int32_t>
      nodes;  // GRID numbers, nodes per cell each, order of cell.hpp; 0: no mid-side node
  std::vector<Origin> origins;
};

/// CORD1 (by grids) or CORD2 (by points in `reference`).
struct RawSystem {
  System::Kind kind = System::Kind::kRectangular;
  Origin origin = 0;
  bool by_grids = false;
  std::array<int32_t, 3> grids{};
  int32_t reference = 0;
  std::array<double, 9> points{};  // A, B, C
};

struct RawSkin {  // CTRIA3, CTRIA6, CTRIAR, CQUAD4, CQUAD8, CQUADR
  std::string kind;
  FaceType type = FaceType::kTri3;
  int32_t id = 0, property = 0;
  Origin origin = 0;
  std::array<int32_t, kMaxFaceNodes> grids{};
};

struct RawShell {  // PSHELL, PCOMP
  Origin origin = 0;
  std::string card;
  int32_t material = 0;    // 0: none
  double thickness = 0.0;  // 0: not known
};

struct RawSolid {  // PSOLID
  Origin origin = 0;
  int32_t material = 0;
  int32_t system = 0;  // -1: element axes
  std::string integration, scheme;
};

struct RawMaterial {
  Origin origin = 0;
  Material::Kind kind = Material::Kind::kIsotropic;
  std::array<double, 3> moduli{};  // MAT1: E, G, NU; NaN: blank
  std::vector<double> constants;   // MAT9
  double density = 0.0, reference_temperature = 0.0;
  std::vector<double> expansion;
};

struct RawRigid {  // RBE2
  int32_t id = 0;
  Origin origin = 0;
  int32_t reference = 0;
  DofMask dofs = 0;
  IdList dependents;
};

struct RawDistributing {  // RBE3
  struct Term {
    double weight = 1.0;
    DofMask dofs = 0;
    IdList grids;
  };
  int32_t id = 0;
  Origin origin = 0;
  int32_t reference = 0;
  DofMask dofs = 0;
  std::vector<Term> terms;
};

struct RawMass {  // CONM2
  Origin origin = 0;
  int32_t grid = 0, system = 0;
  double mass = 0.0;
  std::array<double, 3> offset{};
  std::array<double, 6> inertia{};  // I11 I21 I22 I31 I32 I33
};

struct RawSpring {  // CELAS1, CELAS2
  struct End {
    int32_t grid = 0;
    int direction = 0;
  };
  Origin origin = 0;
  int32_t property = 0;  // PELAS; 0: own stiffness
  double stiffness = 0.0;
  std::vector<End> ends;  // one: against the ground
};

/// SPC, SPC1, ASET, ASET1, BSET, BSET1.
struct RawHold {
  int32_t set = 0;
  Origin origin = 0;
  DofMask dofs = 0;
  double value = 0.0;
  IdList grids;
};

struct RawEquation {  // MPC
  struct Term {
    int32_t grid = 0;
    int direction = 0;
    double coefficient = 0.0;
  };
  int32_t set = 0;
  Origin origin = 0;
  std::vector<Term> terms;
};

struct RawForce {  // FORCE, MOMENT
  Origin origin = 0;
  int32_t grid = 0, system = 0;
  bool moment = false;
  std::array<double, 3> vector{};
};

struct RawPressure {  // PLOAD4
  Origin origin = 0;
  int32_t cell = 0;
  double value = 0.0;
  int32_t g1 = 0, g34 = 0;  // 0: blank
};

struct RawGravity {
  Origin origin = 0;
  int32_t system = 0;
  std::array<double, 3> vector{};
};

struct RawRotation {  // RFORCE
  Origin origin = 0;
  int32_t grid = 0, system = 0;  // 0: origin, basic
  double turns = 0.0;            // revolutions per unit of time
  std::array<double, 3> axis{};  // unit vector in the system
};

/// All cards of one load set.
struct LoadSet {
  Origin origin = 0;
  std::vector<RawForce> forces;
  std::vector<RawPressure> pressures;
  std::vector<RawGravity> gravity;
  std::vector<RawRotation> rotations;
};

/// LOAD: sum of sets, each with its factor.
struct LoadSum {
  Origin origin = 0;
  std::vector<std::pair<double, int32_t>> terms;
};

struct TemperatureSet {
  struct Value {
    int32_t grid;
    double value;
    Origin origin;
  };
  Origin origin = 0;
  bool has_default = false;
  double default_value = 0.0;
  std::vector<Value> values;
};

struct NodeSet {  // SET1
  Origin origin = 0;
  IdList grids;
};

/// SPCADD, MPCADD: sets that are sums of others.
struct SetSum {
  Origin origin = 0;
  IdList sets;
};

struct RawDeck {
  Control control;
  std::vector<std::string> notes;  // Deck::notes
  GridDefaults defaults;
  bool has_defaults = false;
  Grids grids;
  std::vector<RawBlock> blocks;
  std::map<std::pair<CellType, int32_t>, size_t> block_index;  // by type and property
  std::map<int32_t, RawSystem> systems;
  std::map<int32_t, RawSolid> solids;
  std::vector<RawSkin> skins;
  std::map<int32_t, RawShell> shells;
  std::map<int32_t, RawMaterial> materials;
  std::vector<RawRigid> rigid;
  std::vector<RawDistributing> distributing;
  std::vector<RawMass> masses;
  std::vector<RawSpring> springs;
  std::map<int32_t, double> spring_stiffness;   // PELAS
  std::map<int32_t, std::vector<RawHold>> spc;  // by set
  std::map<int32_t, SetSum> spc_sums, mpc_sums;
  std::map<int32_t, std::vector<RawEquation>> mpc;
  std::vector<RawHold> retained;
  std::map<int32_t, NodeSet> node_sets;
  std::map<int32_t, LoadSet> loads;
  std::map<int32_t, LoadSum> load_sums;
  std::map<int32_t, TemperatureSet> temperatures;
  std::map<int32_t, int32_t> eigen_counts;  // EIGRL, EIGR: number of modes, 0: not given

  // Content of "$ clatter" comments (writer.hpp).
  std::map<int32_t, std::string> region_names, set_names;
  std::map<int32_t, std::array<double, 3>> exact;  // coordinates of GRIDs still to come
  struct NamedSurface {
    std::string name;
    Origin origin = 0;
    std::vector<FaceType> types;  // of each face
    std::vector<int32_t> nodes;   // kMaxFaceNodes GRID numbers a face, 0 after the last one
  };
  std::vector<NamedSurface> surfaces;
};

}  // namespace clatter::mesh::deck::nastran
