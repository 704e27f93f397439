// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The content of a Nastran or Abaqus/CalculiX deck besides its mesh, in one form for both.
//
// Readers keep the deck's own units; convert_units() (units.hpp) converts everything to SI at once.
// recipe/text.hpp writes it as the fe.toml of the next stage, so that the user sees all that was
// read. Unsupported input is an error with file and line, never dropped.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/matrix.hpp"
#include "core/mesh/mesh.hpp"
#include "core/recipe/recipe.hpp"

namespace clatter::mesh::deck {

/// A node that belongs to no cell: reference node of couplings and masses, six DoFs.
struct Point {
  int32_t id = 0;         // number in the deck
  Eigen::Vector3d at;     // basic frame
  bool of_bolt = false;   // the reference of a Bolt: its only motion is along the bolt
  bool left_out = false;  // nothing that remains refers to it
};

/// Mesh nodes and points in one numbering: 0 ... n_nodes - 1 are mesh nodes, n_nodes + p is
/// Deck::points[p].
using NodeIndex = int32_t;

/// Directions x y z rx ry rz as bits 0 to 5.
using DofMask = uint8_t;
inline constexpr DofMask kTranslations = 0b000111, kAllDofs = 0b111111;

/// A coordinate system other than the basic one. Columns of `axes` are its x, y, z (for the curved
/// ones: zero angle, second axis, axis of revolution).
struct System {
  enum class Kind { kRectangular, kCylindrical, kSpherical };
  std::string name, where;
  Kind kind = Kind::kRectangular;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// Linear elastic material. Constants by kind:
///   isotropic    E, nu
///   orthotropic  E1, E2, E3, nu12, nu13, nu23, G12, G13, G23  (nu12/E1 = nu21/E2)
///   anisotropic  21 of the symmetric 6 x 6 matrix of stresses 11 22 33 12 23 31 to engineering
///                strains in that order, upper triangle row by row: C11 C12 ... C16 C22 ... C66
struct Material {
  enum class Kind { kIsotropic, kOrthotropic, kAnisotropic };
  std::string name, where;
  Kind kind = Kind::kIsotropic;
  std::vector<double> constants;
  bool of_sheets = false;  // some constants have no part in a sheet, and are not known
  double density = 0.0;    // 0: the deck has none
  double loss_factor = 0.0;
  std::vector<double> expansion;  // 1 (isotropic), 3 (along the axes) or none [1/K]
  double reference_temperature = 0.0;
  double mass_damping = 0.0;       // the deck's damping: this times M [1/time]
  double stiffness_damping = 0.0;  // plus this times K [time]
};

/// Integration of each cell type of a region, if the deck specifies it.
enum class Formulation { kDefault, kFull, kReduced, kIncompatible, kFine };

/// Properties of each of Mesh::regions.
struct Region {
  std::string material;  // name of a Material
  std::string system;    // axes of the material; empty: basic
  std::string where;
  std::map<CellType, Formulation> formulation;
};

/// RBE2, kinematic coupling, rigid body: `dofs` of the dependents follow the reference.
struct Rigid {
  std::string name, where;
  NodeIndex reference = 0;
  DofMask dofs = kAllDofs;  // rotations count on points only
  std::vector<NodeIndex> dependents;
};

/// RBE3, distributing coupling: the reference follows the weighted mean of the others.
struct Distributing {
  struct Term {
    double weight = 1.0;
    DofMask dofs = kTranslations;
    std::vector<NodeIndex> node_indices;
  };
  std::string name, where;
  NodeIndex reference = 0;
  DofMask dofs = kAllDofs;  // of the reference
  std::vector<Term> terms;  // by weight; or
  std::string surface;      // weights are the areas of this surface
};

struct Tie {
  std::string name, where;
  std::string slave, master;  // surfaces of the mesh
  double distance = -1.0;     // largest tied gap; < 0: default of the assembler
  std::string edge = {};      // instead of slave: node set with the edge of a sheet
};

/// A bolt, cut through: u_slave - u_master = d direction, d the displacement of `reference`.
struct Bolt {
  std::string where;
  std::string slave, master;  // surfaces of the mesh: the two sides of the cut
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  NodeIndex reference = 0;  // a point
};

/// sum coefficient * u = 0, or *EQUATION / MPC.
struct Equation {
  struct Term {
    NodeIndex node_index = 0;
    int direction = 0;  // 0 to 5
    double coefficient = 0.0;
  };
  std::string where;
  std::vector<Term> terms;  // the first one is dependent
};

/// Scalar spring: its elongation is sum coefficient * u.
struct Spring {
  std::string where;
  double stiffness = 0.0;  // force per length; of rotations moment per angle
  std::vector<Equation::Term> terms;
  double loss_factor = 0.0;
};

/// Bar, beam or truss between two nodes or points. The position in the deck is its source.
struct Beam : recipe::Beam {
  std::array<NodeIndex, 2> ends{};
};

struct Mass {
  std::string where;
  NodeIndex node_index = 0;
  double mass = 0.0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre of mass, basic axes
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();   // centre of mass minus node, basic axes
};

/// Stiffness or mass between DoFs, beside the cells (DMIG, CONM1, CMASS).
struct NodalMatrix {
  std::string name, where;
  bool is_mass = false;
  std::vector<Equation::Term> terms;  // one per row; coefficients are unused
  Eigen::MatrixXd values;             // symmetric
  double loss_factor = 0.0;           // of a stiffness
};

/// Displacements fixed at zero, or in a step at a value.
struct Support {
  std::string name, where;
  std::vector<NodeIndex> node_indices;
  DofMask dofs = kTranslations;
  std::string system;  // directions; empty: basic
  double value = 0.0;  // displacement, or rotation [rad]
};

/// One step or subcase.
struct Step {
  struct NodalForce {
    NodeIndex node_index = 0;
    int direction = 0;  // 0 to 5
    double value = 0.0;
    std::string system;  // of the direction; empty: basic
  };
  struct Pressure {
    std::string surface;  // of the mesh; positive: compression
    double value = 0.0;
  };
  struct Rotation {
    double omega_squared = 0.0;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  // of the axis
    Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // unit vector
    std::vector<std::string> regions;                 // that rotate; empty: all
  };
  enum class Kind { kStatic, kFrequency, kNone };
  std::string name, where;
  Kind kind = Kind::kNone;
  int modes = 0;                  // frequency steps: how many
  std::vector<Support> supports;  // of this step
  std::vector<NodalForce> forces;
  std::vector<Pressure> pressures;
  std::vector<Rotation> rotations;
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // body force per mass (gravity)
  RowMatrix accelerations{};     // of the nodes, n x 3: the same on the cells alone; or empty
  std::vector<Support> moved{};  // values of supports, in this step alone
  std::string temperature;       // field of the mesh, n x 1, temperature; empty: no thermal load
};

/// Damping that the deck gives: this times M and times K.
struct Damping {
  std::string where, of;   // "GLOBAL DAMPING"
  double mass = 0.0;       // [1/time]
  double stiffness = 0.0;  // [time]
};

/// Something done to cells.
struct Repair {
  int64_t cells = 0;  // how many
  std::string text;   // a sentence, with their number
};

/// Mass matrix of the cells.
enum class MassForm { kConsistent, kLumped };

/// The entire deck. `regions` is parallel to Mesh::regions; nodes without cells are only in
/// `points`.
struct Deck {
  Mesh mesh;
  std::vector<std::string> files;  // the deck and all included files
  std::vector<Point> points;
  std::map<std::string, std::vector<NodeIndex>> sets;  // node sets that contain points too
  std::map<std::string, System> systems;
  std::map<std::string, Material> materials;
  std::vector<Region> regions;
  std::vector<recipe::Shell> shells;  // sections of regions of shells
  std::vector<Rigid> rigid;
  std::vector<Distributing> distributing;
  std::vector<Tie> ties;
  std::vector<Bolt> bolts;
  std::vector<Equation> equations;
  std::vector<Spring> springs;
  std::vector<Beam> beams;
  std::vector<Mass> masses;
  std::vector<NodalMatrix> matrices;
  std::vector<Support> supports;  // of the entire model
  std::vector<Support> retained;  // ASET, BSET: boundary DoFs of a condensation (value unused)
  std::vector<Step> steps;
  MassForm mass = MassForm::kConsistent;   // of the cells, as the deck's program makes it
  std::map<std::string, int64_t> ignored;  // ignored input, with counts
  std::string passed;                      // Contents::passed_line()
  std::vector<Damping> damping;            // of the entire model
  std::vector<Repair> renumbered;          // cells: what repair_cells() did
  std::vector<std::string> notes;          // "file:line: ...": remarks for the user
};

class Contents;

/// How to read a deck.
struct ReadOptions {
  std::vector<std::string>
      ignore;  // cards or keywords to skip, any case: "CQUAD4", "*SHELL SECTION"
  std::optional<MassForm> mass = std::nullopt;  // absent: as in the deck
  Contents* contents = nullptr;  // to record what the deck holds, also when it is refused
};

}  // namespace clatter::mesh::deck
