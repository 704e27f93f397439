// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Contents of a part's fe.toml (core/recipe) on its mesh: names became nodes, regions and axes.
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
#include "core/fe/fe_gasket.hpp"
#include "core/fe/material.hpp"
#include "core/fe/prestress.hpp"
#include "core/mesh/mesh.hpp"
#include "core/recipe/recipe.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

using recipe::MatrixFiles;

/// A surface or a node set of the mesh, or a point.
struct Selection : recipe::Selection {
  std::string where;  // for messages: "file:line: table"
};

/// [[point]] at its position.
struct PointSpec {
  ReferencePoint point;
  int32_t number = 0;  // in the deck of the mesh; 0: none
  std::string where;
};

/// [[support]] with its axes.
struct SupportSpec : recipe::Support {
  fe::Axes axes;
  std::string where;
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

/// [[tie]] and [[bolt]].
struct TieSpec : recipe::Tie {
  bool bolt = false;  // one relative displacement along `direction` stays free
  std::string where;
};

/// [[gasket]].
struct GasketSpec : TieSpec {
  double normal = 0.0, tangential = 0.0;  // stiffnesses per area [N/m3]
  double loss_factor = 0.0;
  fe::GasketCurve curve{};                     // for statics; without points none
  std::optional<fe::PressedPoints> pressed{};  // has stiffness there alone
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
  double loss_factor = 0.0;
};

/// [[matrix]]: stiffness or mass between DoFs, beside the cells.
struct MatrixSpec {
  std::string name, where;
  bool is_mass = false;
  std::vector<EquationSpec::Term> terms;  // one per row; coefficients are unused
  Eigen::MatrixXd values;                 // symmetric; K [N/m, N, N m], M [kg, kg m, kg m2]
  double loss_factor = 0.0;               // of K
};

/// [[straight_edges]].
struct StraightEdgesSpec : recipe::StraightEdges {
  std::string where;
};

/// [[contact]]: a grid of patches on a cylinder surface.
struct ContactSpec {
  std::string name, surface, where;
  PatchGridSpec grid;
};

/// [[mean]].
struct MeanSpec : recipe::Mean {
  std::string where;
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

/// [[surface_mass]].
struct SurfaceMassSpec : recipe::SurfaceMass {
  std::string where;
};

/// [[heat]] on the mesh.
struct HeatSpec {
  struct Film {
    std::string surface;
    Profile coefficient;  // [W/(m2 K)]
    Profile temperature;  // of the fluid [K], at the same positions
  };
  struct Flux {
    std::string surface;
    Profile flux;  // into the part [W/m2]
  };
  struct Fixed {
    Selection selection;
    double temperature = 0.0;  // [K]
  };
  struct Source {
    std::vector<std::string> regions;
    std::vector<double> power;  // of each region of the mesh [W/m3]
  };
  using Contact = recipe::Heat::Conductance;
  std::string name, where;
  std::vector<Film> films{};
  std::vector<Flux> fluxes{};
  std::vector<Fixed> fixed{};
  std::vector<Source> sources{};
  std::vector<Contact> contacts{};
};

/// [[load]] on the mesh: also of resultants and uniform accelerations `force` is the force or
/// acceleration of one unit.
struct LoadSpec : recipe::Load {
  std::string where{};
  Eigen::VectorXd node_rises{};      // of temperature, by regions or a table [K], or empty
  Eigen::VectorXd node_pressures{};  // on the surface by a table (n_nodes) [Pa]; or empty: 1 Pa
  std::vector<int32_t> rotating{};   // rotating regions; empty: all, and point masses
  fe::Axes axes{};                   // of `directions`
  double amount = 0.0;  // displacement [m] or [rad]; factor of a field; temperature of a field or
                        // [[heat]] without strain [K], or the rise [K]

  /// The same acceleration everywhere, not a field.
  bool is_uniform_acceleration() const { return kind == Kind::kAcceleration && field.empty(); }
};

/// A coordinate of a reduced part: of a node of the mesh, or one of its own.
struct PartCoordinate {
  int32_t node = -1;                                // of the mesh, or -1
  bool is_rotation = false;                         // of that node
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  // the direction there, unit vector
  int32_t own = -1;                                 // number among the own ones of all parts, or -1
};

/// [[part]] at its place.
struct PartSpec : recipe::Part {
  std::string where;
  rom::ReducedModel model;                  // in the axes of the assembly
  std::vector<PartCoordinate> coordinates;  // as many as the model has
  std::vector<std::string> sheets;          // surfaces that are shells, which have two sides
  std::map<int32_t, int> without;           // nodes that do not turn about one axis, 3 to 5

  /// All of the set are coordinates: none is a combination of others.
  bool has(const std::string& set) const {
    return std::ranges::all_of(model.sets.at(set).dofs,
                               [&](int32_t dof) { return dof < model.size(); });
  }
};

struct Recipe {
  std::vector<PartSpec> parts;
  std::vector<fe::Material> materials;     // one per region of the mesh
  std::vector<fe::ShellSection> sections;  // likewise; of those with shells
  fe::MassForm mass = fe::MassForm::kConsistent;
  recipe::Damping damping;
  std::optional<fe::Prestress> prestress;
  std::vector<PointSpec> points;
  std::vector<SupportSpec> supports;
  std::vector<CouplingSpec> couplings;
  std::vector<EquationSpec> equations;
  std::vector<SpringSpec> springs;
  std::vector<MatrixSpec> matrices;
  std::vector<StraightEdgesSpec> straight_edges;
  std::vector<TieSpec> ties;  // bolts too
  std::vector<GasketSpec> gaskets;
  std::vector<ContactSpec> contacts;
  std::vector<MeanSpec> means;
  std::vector<NodeSpec> nodes;
  std::vector<PointMassSpec> point_masses;
  std::vector<SurfaceMassSpec> surface_masses;
  std::vector<HeatSpec> heats;
  std::vector<LoadSpec> loads;
  std::map<std::string, std::map<std::string, double>> cases;  // [[case]]: factors of loads
  std::vector<std::filesystem::path> files;                    // read in addition to the fe.toml
};

/// Checks a file that was read, or that the reader of a deck made, against the mesh. InputError
/// with "file:line: key: found ..., expected ..." for unknown regions, surfaces, sets, duplicate
/// names, values out of range.
Recipe read_recipe(recipe::File file, const mesh::Mesh& mesh);
/// Reads the file first; InputError also for unknown keys. The nodes of its reduced parts
/// (attach_parts()) are added to the mesh.
Recipe read_recipe(const Config& config, mesh::Mesh& mesh);

}  // namespace clatter::assembly
