// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Contents of a part's fe.toml. assembly/README.md documents the file; lengths here are in metres.
#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assembly/coupling/contact_patch.hpp"
#include "assembly/coupling/dof_numbers.hpp"
#include "assembly/recipe/profile.hpp"
#include "core/base/config.hpp"
#include "core/fe/assemble.hpp"
#include "core/fe/axes.hpp"
#include "core/fe/material.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// [damping]: D = alpha K + beta M.
struct DampingSpec {
  double alpha = 0.0;                  // [s]
  double beta = 0.0;                   // [1/s]
  std::optional<double> ratio, at_hz;  // of critical at a frequency, which give alpha
};

/// A surface or a node set of the mesh, or a point.
struct Selection {
  std::string surface, node_set, point;  // exactly one is not empty
  std::string where;                     // for messages: "file:line: table"
};

/// [[point]]: a reference node with six DoFs of its own.
struct PointSpec {
  ReferencePoint point;
  int32_t number = 0;    // in the deck of the mesh; 0: none
  std::string node_set;  // of its node, or empty
  std::string where;
};

/// [[support]]: displacements held at zero, or at the values of a [[load]].
struct SupportSpec {
  std::string name;
  Selection selection;
  std::vector<int> directions = {0, 1, 2};  // of `axes`; 3 ... 5: rotations of a point
  std::string system;                       // name of `axes`, or empty
  fe::Axes axes;
};

/// [[coupling.term]], [[nodes.term]]: nodes and points, and some of their directions.
struct TermSpec {
  Selection selection;
  double weight = 1.0;  // of each node; of each m2 on a surface
  std::vector<int> directions = {0, 1, 2};
  fe::Axes axes;  // of the directions; [[nodes]] only
};

/// [[coupling]]: a reference node that follows a face (distributing, RBE3), or that others follow
/// (rigid, RBE2).
struct CouplingSpec {
  std::string name, kind, where;
  bool rigid = false;
  std::optional<Eigen::Vector3d> at;  // of its own reference node; absent: the face's centroid
  std::string on_point;               // or a [[point]] as the reference
  std::vector<TermSpec> terms;  // rigid: the followers; directions are used only when distributing
  std::vector<int> directions = {0, 1, 2, 3, 4, 5};  // rigid: of the followers; else: reference
};

/// [[tie]] and [[bolt]]: a slave surface that follows a master surface.
struct TieSpec {
  std::string name, slave, master, where;
  std::optional<double> distance;  // largest gap [m]; absent: a tenth of the mean slave face size
  bool bolt = false;               // one relative displacement along `direction` stays free
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // unit vector from slave to master
};

/// [[equation]]: sum coefficient * u = 0; the first term depends on the others.
struct EquationSpec {
  struct Term {
    Selection selection;  // one node, or a point
    int direction = 0;
    double coefficient = 1.0;
  };
  std::string where;
  std::vector<Term> terms;
};

/// [[spring]]: elongation = sum coefficient * u, restoring force = stiffness * elongation.
struct SpringSpec {
  std::string name, where;
  double stiffness = 0.0;  // [N/m]; of rotations [N m/rad]
  std::vector<EquationSpec::Term> terms;
};

/// [[matrix]]: stiffness or mass between DoFs, beside the cells.
struct MatrixSpec {
  std::string name, where;
  bool is_mass = false;
  std::vector<EquationSpec::Term> terms;  // one per row; coefficients are unused
  Eigen::MatrixXd values;                 // symmetric; K [N/m, N, N m], M [kg, kg m, kg m2]
};

/// [[straight_edges]]: mid-side nodes that move with the mean of the two ends of their edge.
struct StraightEdgesSpec {
  std::string node_set, where;
};

/// [[contact]]: a grid of patches on a cylinder surface.
struct ContactSpec {
  std::string name, surface, where;
  PatchGridSpec grid;
};

/// [[mean]]: mean displacement of a face along a direction.
struct MeanSpec {
  std::string name, surface, where;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  std::optional<std::pair<double, double>> range;  // along the direction [m]
};

/// [[sensor]]: the node of a surface nearest to a point; [[nodes]]: nodes and points.
struct NodeSpec {
  std::string name, kind, where;
  std::vector<TermSpec> terms;  // without directions: all that each node or point has
  std::optional<Eigen::Vector3d> near;
};

/// [[point_mass]] on a reference node, a point or plain nodes.
struct PointMassSpec {
  std::string on, where;
  double mass = 0.0;                                  // [kg]
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();   // of its centre from the node [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about its centre [kg m2]
};

/// [[heat]]: boundary conditions and sources of a steady temperature field.
struct HeatSpec {
  /// Of a fluid at a surface.
  struct Film {
    std::string surface;
    Profile coefficient;            // [W/(m2 K)]
    Profile temperature;            // of the fluid [K], at the same positions
    std::filesystem::path table{};  // of points, from which both come; or empty
  };
  struct Flux {
    std::string surface;
    Profile flux;                   // into the part [W/m2]
    std::filesystem::path table{};  // of points, from which it comes; or empty
  };
  struct Fixed {
    Selection selection;
    double temperature = 0.0;  // [K]
  };
  struct Source {
    std::vector<std::string> regions;
    double value = 0.0;         // [W/m3]
    std::vector<double> power;  // of each region of the mesh [W/m3]
  };
  struct Contact {
    std::string tie;           // a [[tie]] or [[bolt]]
    double conductance = 0.0;  // [W/(m2 K)]
  };
  std::string name, where;
  std::vector<Film> films;
  std::vector<Flux> fluxes;
  std::vector<Fixed> fixed;
  std::vector<Source> sources;
  std::vector<Contact> contacts;  // of the other ties both sides have the same temperature
};

/// [[load]]: a unit load case.
struct LoadSpec {
  enum class Kind {
    kPressure,
    kResultant,
    kForce,
    kGravity,
    kCentrifugal,
    kDisplacement,
    kNodal,
    kAcceleration,  // a field of the mesh; uniform ones are kGravity
    kTemperature
  };
  std::string name, unit, where;
  Kind kind = Kind::kPressure;
  std::string surface, set;  // set: also the name of a point
  std::string field;         // of the mesh: n x 3 [N] or [m/s2], times `value`; n x 1 [K], minus it
  std::string heat;          // a [[heat]]: its temperatures, minus `value`
  Eigen::VectorXd rise;      // temperature rise of the nodes by regions or a table [K], or empty
  Eigen::VectorXd pressure;  // on `surface` by a table, at its nodes (n_nodes) [Pa]; or empty: 1 Pa
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // [N] per unit; gravity: unit vector
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // [N m] per unit
  fe::RotationAxis axis;                             // centrifugal: axis of rotation and
  std::vector<int32_t> rotating;  // rotating regions; empty: all, and point masses
  Selection selection;            // prescribed displacement:
  std::vector<int> directions;    // of `axes`
  fe::Axes axes;
  double value = 0.0;  // [m] or [rad]; with a field see `field`; else the rise [K]
};

struct Recipe {
  std::vector<fe::Material> materials;  // one per region of the mesh
  fe::MassForm mass = fe::MassForm::kConsistent;
  DampingSpec damping;
  std::vector<PointSpec> points;
  std::vector<SupportSpec> supports;
  std::vector<CouplingSpec> couplings;
  std::vector<EquationSpec> equations;
  std::vector<SpringSpec> springs;
  std::vector<MatrixSpec> matrices;
  std::vector<StraightEdgesSpec> straight_edges;
  std::vector<TieSpec> ties;  // bolts too
  std::vector<ContactSpec> contacts;
  std::vector<MeanSpec> means;
  std::vector<NodeSpec> nodes;
  std::vector<PointMassSpec> point_masses;
  std::vector<HeatSpec> heats;
  std::vector<LoadSpec> loads;
  std::map<std::string, std::map<std::string, double>> cases;  // [[case]]: factors of loads
  std::vector<std::filesystem::path> files;                    // read in addition to the fe.toml
};

/// The keys of a fe.toml.
const keys::Table& recipe_table();

/// Reads the entire file and checks it against the mesh; InputError with "file:line: key: found
/// ..., expected ..." for unknown keys, regions, surfaces, sets, duplicate names, values out of
/// range.
Recipe read_recipe(const Config& config, const mesh::Mesh& mesh);

}  // namespace clatter::assembly
