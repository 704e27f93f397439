#pragma once
// What a part's fe.toml says. assembly/README.md shows the file; lengths are in metres here.
#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assembly/contact_patch.hpp"
#include "assembly/dof_numbers.hpp"
#include "core/base/config.hpp"
#include "core/fe/assemble.hpp"
#include "core/fe/axes.hpp"
#include "core/fe/material.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// [damping]: D = alpha K + beta M.
struct DampingSpec {
  double alpha = 0.0;  // [s]
  double beta = 0.0;   // [1/s]
};

/// A surface or a node set of the mesh, or a point.
struct Place {
  std::string surface, node_set, point;  // all but one are empty
  std::string where;                     // for messages: "file:line: table"
};

/// [[point]]: a reference node with six DoFs of its own.
struct PointSpec {
  ReferencePoint point;
  std::string where;
};

/// [[support]]: displacements held at zero, or at the values of a [[load]].
struct SupportSpec {
  std::string name;
  Place place;
  std::vector<int> directions = {0, 1, 2};  // of `axes`; 3 ... 5: rotations of a point
  fe::Axes axes;
};

/// [[coupling.term]]: places by which a reference node moves.
struct TermSpec {
  Place place;
  double weight = 1.0;  // of each node; of each m2 on a surface
  std::vector<int> directions = {0, 1, 2};
};

/// [[coupling]]: a reference node that rides on a face (distributing, RBE3), or that others follow
/// (rigid, RBE2).
struct CouplingSpec {
  std::string name, kind, where;
  bool rigid = false;
  std::optional<Eigen::Vector3d> at;  // of its own reference node; absent: the face's centroid
  std::string on_point;               // or a [[point]] as the reference
  std::vector<TermSpec> terms;  // rigid: what follows; directions count only when distributing
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
    Place place;  // one node, or a point
    int direction = 0;
    double coefficient = 1.0;
  };
  std::string where;
  std::vector<Term> terms;
};

/// [[spring]]: its elongation is sum coefficient * u, the force against it stiffness times that.
struct SpringSpec {
  std::string name, where;
  double stiffness = 0.0;  // [N/m]; of rotations [N m/rad]
  std::vector<EquationSpec::Term> terms;
};

/// [[straight_edges]]: middle nodes that move with the ends of their edge, the mean of both.
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

/// [[sensor]]: the node of a surface nearest to a point; [[nodes]]: a plain node set.
struct NodeSpec {
  std::string name, kind;
  Place place;
  std::optional<Eigen::Vector3d> near;
};

/// [[point_mass]] on a reference node, a point or plain nodes.
struct PointMassSpec {
  std::string on, where;
  double mass = 0.0;                                  // [kg]
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();   // of its centre from the node [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about its centre [kg m2]
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
    kTemperature
  };
  std::string name, unit, where;
  Kind kind = Kind::kPressure;
  std::string surface, set;  // set: also the name of a point
  std::string field;         // of the mesh: n x 3 [N], times `value`; n x 1 [K], minus `value`
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // [N] per unit; gravity: unit vector
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // [N m] per unit
  fe::RotationAxis axis;                             // centrifugal: of the part, and
  std::vector<int32_t> turning;                      // the regions that turn; none: all and masses
  Place place;                                       // prescribed displacement:
  std::vector<int> directions;                       // of `axes`
  fe::Axes axes;
  double value = 0.0;  // [m] or [rad]; of a field see there; without one the rise [K]
};

struct Recipe {
  std::vector<fe::Material> materials;  // one a region of the mesh
  fe::MassForm mass = fe::MassForm::kConsistent;
  DampingSpec damping;
  std::vector<PointSpec> points;
  std::vector<SupportSpec> supports;
  std::vector<CouplingSpec> couplings;
  std::vector<EquationSpec> equations;
  std::vector<SpringSpec> springs;
  std::vector<StraightEdgesSpec> straight_edges;
  std::vector<TieSpec> ties;  // bolts too
  std::vector<ContactSpec> contacts;
  std::vector<MeanSpec> means;
  std::vector<NodeSpec> nodes;
  std::vector<PointMassSpec> point_masses;
  std::vector<LoadSpec> loads;
  std::map<std::string, std::map<std::string, double>> cases;  // [[case]]: factors of loads
};

/// Reads and checks the whole file against the mesh; InputError with "file:line: key: found ...,
/// expected ..." for unknown keys, regions, surfaces, sets, double names, values out of range.
Recipe read_recipe(const Config& config, const mesh::Mesh& mesh);

}  // namespace clatter::assembly
