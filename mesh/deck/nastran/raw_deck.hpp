// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The bulk data as written: numbers, units and coordinate systems of the deck.
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesh/deck/chunked.hpp"
#include "mesh/deck/nastran/card.hpp"
#include "mesh/deck/nastran/control.hpp"
#include "mesh/deck/nastran/raw_bars.hpp"
#include "mesh/deck/nastran/raw_fasteners.hpp"
#include "mesh/deck/nastran/raw_skins.hpp"

namespace clatter::mesh::deck::nastran {

/// Values of a GRID field with a default in GRDSET while cards are read: blank, or an explicit
/// zero.
inline constexpr int32_t kBlank = 0, kZero = -2;
inline constexpr int32_t kNoRow = -1;  // of a mid-side node that the card omits
inline constexpr DofMask kNoneHeld = 0x80;
inline constexpr int kScalar = -1;  // direction of a scalar point, which has no component

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

struct RawSolid {  // PSOLID
  Origin origin = 0;
  int32_t material = 0;
  int32_t system = 0;  // -1: element axes
  std::string integration, scheme;
  bool fluid = false;  // FCTN
};

struct RawMaterial {
  Origin origin = 0;
  Material::Kind kind = Material::Kind::kIsotropic;
  bool of_sheets = false;          // MAT2, MAT8
  std::array<double, 3> moduli{};  // MAT1: E, G, NU; NaN: blank
  std::vector<double> constants;   // of others; 0 where MAT8 is blank
  double density = 0.0, reference_temperature = 0.0;
  double loss_factor = 0.0;  // GE
  std::vector<double> expansion;
};

struct RawRigid {    // RBE2, and what is the same
  std::string name;  // "rbe2_5"
  int32_t id = 0;
  Origin origin = 0;
  int32_t reference = 0;
  DofMask dofs = 0;
  IdList dependents;
};

/// RBAR, RBE1 with independent DoFs at several grids, RROD.
struct RawLink {
  struct End {
    int32_t grid = 0;
    DofMask dofs = 0;
  };
  std::string name;  // "rbar_5"
  Origin origin = 0;
  std::vector<End> independent, dependent;
  bool along_only = false;  // RROD: its length is constant, no more
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
  int32_t id = 0;
  Origin origin = 0;
  int32_t grid = 0, system = 0;
  double mass = 0.0;
  std::array<double, 3> offset{};
  std::array<double, 6> inertia{};  // I11 I21 I22 I31 I32 I33
};

struct RawMassMatrix {  // CONM1
  Origin origin = 0;
  int32_t grid = 0, system = 0;
  std::array<double, 21> lower{};  // M11 M21 M22 M31 ... M66
};

struct RawSpring {  // CELAS1 to CELAS4, CMASS1 to CMASS4
  struct End {
    int32_t grid = 0;
    int direction = 0;
  };
  Origin origin = 0;
  bool is_mass = false;
  int32_t property = 0;      // PELAS or PMASS; 0: own value
  double value = 0.0;        // stiffness or mass
  double loss_factor = 0.0;  // GE of own value
  std::vector<End> ends;     // one: against the ground
};

struct RawBush {  // CBUSH, CGAP
  Origin origin = 0;
  int32_t id = 0, property = 0;
  std::array<int32_t, 2> grids{};  // the second 0: the ground
  int32_t orientation_grid = 0;    // GO
  std::array<double, 3> orientation{};
  int32_t system = -1;         // CID
  double share = 0.5;          // S: position of the springs from GA to GB
  int32_t offset_system = -1;  // OCID; -1: S counts
  std::array<double, 3> offset{};
  bool is_gap = false;
};

struct RawBushProperty {  // PBUSH
  Origin origin = 0;
  std::array<double, 6> stiffness{};
  std::array<double, 6> loss_factors{};  // GE1 to GE6; GE1 alone may count for all
};

struct RawSpringProperty {  // PELAS
  double stiffness = 0.0, loss_factor = 0.0;
};

struct RawGapProperty {  // PGAP
  Origin origin = 0;
  bool is_open = false;
  double along = 0.0, across = 0.0;  // stiffness of the initial state
};

/// DMIG of one name.
struct RawDirect {
  struct Entry {
    int32_t grid[2];
    int direction[2];  // of column and row
    double value;
  };
  static constexpr int kSymmetric = 6, kComplex = -1, kUsed = -2;
  Origin origin = 0;
  int form = 0;  // IFO, or kComplex; 0: no header
  std::vector<Entry> entries;
};

struct RawGlue {  // BGSET
  struct Pair {
    int32_t source = 0, target = 0;
    double distance = -1.0;
  };
  Origin origin = 0;
  std::vector<Pair> pairs;
};

struct RawFaces {  // BSURFS
  struct Face {
    int32_t cell = 0;
    std::array<int32_t, 3> corners{};
    Origin origin = 0;
  };
  Origin origin = 0;
  std::vector<Face> faces;
};

/// SPC, SPC1, SPCD, ASET, ASET1, BSET, BSET1, CSET, CSET1.
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

struct RawForce {  // FORCE, MOMENT; FORCE1, FORCE2, MOMENT1, MOMENT2
  Origin origin = 0;
  int32_t grid = 0, system = 0;
  bool moment = false;
  std::array<double, 3> vector{};
  std::array<int32_t, 4> along{};  // of FORCE1: from the first grid to the second;
                                   // of FORCE2: (second - first) x (fourth - third)
  double magnitude = 0.0;          // of these
};

struct RawPressure {  // PLOAD4; PLOAD, PLOAD2
  Origin origin = 0;
  int32_t cell = 0;                  // of PLOAD 0
  std::array<double, 4> values{};    // at the corners from G1 on
  int32_t g1 = 0, g34 = 0;           // 0: blank
  std::array<int32_t, 4> corners{};  // of PLOAD, in the order that gives its direction
  int32_t system = 0;
  std::array<double, 3> direction{};  // zero: along the normal
  bool varies() const {
    return values[1] != values[0] || values[2] != values[0] || values[3] != values[0];
  }
  bool along_vector() const { return direction != std::array<double, 3>{}; }
  bool is_plain() const { return !varies() && !along_vector(); }
};

struct RawGravity {
  Origin origin = 0;
  int32_t system = 0;
  std::array<double, 3> vector{};
};

/// ACCEL1: of some grids; ACCEL that varies: of all.
struct RawAcceleration {
  Origin origin = 0;
  int32_t system = 0;
  std::array<double, 3> vector{};
  IdList grids;
  int along = -1;  // axis of the system along which the factors are given; -1: ACCEL1
  std::vector<std::pair<double, double>> factors;  // position, factor; ascending
};

struct RawRotation {  // RFORCE
  Origin origin = 0;
  int32_t grid = 0, system = 0;  // 0: origin, basic
  double turns = 0.0;            // revolutions per unit of time
  std::array<double, 3> axis{};  // unit vector in the system
};

struct RawSkinPressure {  // PLOAD2; PLOAD4 of two-dimensional cells
  RawPressure pressure;
  IdRange cells;
};

/// All cards of one load set.
struct LoadSet {
  Origin origin = 0;
  std::vector<RawSkinPressure> on_skins;
  std::vector<RawForce> forces;
  std::vector<RawPressure> pressures;
  std::vector<RawGravity> gravity;
  std::vector<RawAcceleration> accelerations;
  std::vector<RawRotation> rotations;
  std::vector<RawHold> moved;  // SPCD
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
  std::vector<RawSkin> shell_cells;  // those of `skins` that find_shells() takes out
  std::map<int32_t, RawShell> shells;
  std::map<int32_t, RawMaterial> materials;
  std::vector<RawRigid> rigid;
  std::vector<RawDistributing> distributing;
  std::vector<RawLink> links;
  std::vector<RawMass> masses;
  std::vector<RawMassMatrix> mass_matrices;
  std::vector<RawSpring> springs;  // and scalar masses
  std::map<int32_t, RawSpringProperty> spring_properties;
  std::map<int32_t, double> scalar_masses;  // PMASS
  std::vector<RawBar> bars;
  std::optional<RawBar> bar_default, beam_default;  // BAROR, BEAMOR
  std::map<int32_t, RawBarProperty> bar_properties;
  std::vector<RawBush> bushes;
  std::map<int32_t, RawBushProperty> bush_properties;
  std::vector<RawFastener> fasteners;
  std::map<int32_t, RawFastenerProperty> fastener_properties;
  std::map<int32_t, RawGapProperty> gap_properties;
  std::map<std::string, RawDirect> direct;                           // DMIG by name
  std::set<int32_t> scalar_points;                                   // SPOINT
  std::map<int32_t, RawGlue> glue;                                   // BGSET by set
  std::map<int32_t, RawFaces> faces;                                 // BSURFS by number
  std::map<int32_t, std::string> other_properties, other_materials;  // card of those not for solids
  std::vector<int32_t> lost_grids;              // of cells that the user ignores
  std::map<int32_t, std::vector<RawHold>> spc;  // by set
  std::map<int32_t, SetSum> spc_sums, mpc_sums;
  std::map<int32_t, std::vector<RawEquation>> mpc;
  std::vector<RawHold> retained;
  std::map<int32_t, NodeSet> node_sets;
  std::map<int32_t, LoadSet> loads;
  std::map<int32_t, LoadSum> load_sums;
  std::map<int32_t, TemperatureSet> temperatures;
  std::map<int32_t, int32_t> eigen_counts;  // EIGRL, EIGR: number of modes, 0: not given
  struct Damping {
    Origin origin = 0;
    int64_t count = 0;
  };
  std::map<std::string, Damping> damping;  // of bushes, which is passed over

  void count_damping(const std::string& field, Origin origin) {
    ++damping.try_emplace(field, Damping{origin, 0}).first->second.count;
  }

  // Content of "$ clatter" comments (writer.hpp).
  std::map<int32_t, std::string> region_names, set_names;
  int32_t first_hanging = 1;  // number of the first mid-side node that no GRID card gives, at least
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
