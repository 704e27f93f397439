// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A part's fe.toml as data, before it is checked against a mesh: one struct a table, lengths in
// metres. Readers of decks fill it, clatter-assembly reads it; rows of keys (keys.hpp) give and
// take its text. assembly/README.md documents the file.
#include <Eigen/Core>
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/units.hpp"
#include "core/fe/axes.hpp"
#include "core/fe/material.hpp"
#include "core/fe/shell_section.hpp"
#include "core/keys/source.hpp"

namespace clatter::recipe {

using keys::Source;

/// [material.NAME] and its regions.
struct RegionMaterial {
  Source source;
  fe::MaterialTable material;
  std::vector<std::string> regions;
};

/// [[shell.layer]].
struct ShellLayer {
  Source source{};
  std::string material{};
  double thickness = 0.0;  // [m]
  double angle = 0.0;      // [rad]
};

/// [[shell]]: the section of the shells of some regions, where the mesh has no thickness or offset
/// of its own.
struct Shell {
  Source source{};
  std::vector<std::string> regions{};
  fe::ShellSection section{};  // without materials, layers and axes, which have names
  std::string system{}, bending_material{}, shear_material{};
  std::vector<ShellLayer> layers{};

  /// Of the sheet, or of all layers [m]; 0: not known.
  double thickness() const {
    double sum = section.thickness;
    for (const ShellLayer& layer : layers) sum += layer.thickness;
    return sum;
  }
};

/// [matrices]: matrices of another program, instead of all other tables.
struct MatrixFiles {
  std::filesystem::path K, M;      // Matrix Market or "i j value" (core/base/matrix_text.hpp)
  std::filesystem::path dofs;      // DoF map (core/rom/dof_map.hpp); empty: the nodes of the mesh
  std::string name;                // of the part; empty: the mesh's
  UnitSystem units;                // of K and M; positions of a map or mesh are in m
  double alpha = 0.0, beta = 0.0;  // D = alpha K + beta M [s], [1/s]
};

/// [[part]]: a reduced part (.rom.h5) that stands in this assembly.
struct Part {
  enum class Mirror { kNone, kX, kY, kZ };
  Source source{};
  std::string name{};
  std::filesystem::path file{};
  bool keeps_names = false;       // else its name and _ come before those of its sets
  std::string system{};           // where its x, y, z lie; empty: the basic frame
  Mirror mirror = Mirror::kNone;  // direction that is reflected before
  /// A name of the part in the assembly.
  std::string named(const std::string& own) const { return keeps_names ? own : name + "_" + own; }
};

/// [mass].
struct Mass {
  Source source;
  fe::MassForm form = fe::MassForm::kConsistent;
};

/// [damping]: D = alpha K + beta M.
struct Damping {
  Source source{};
  double alpha = 0.0;                  // [s]
  double beta = 0.0;                   // [1/s]
  std::optional<double> ratio, at_hz;  // of critical at a frequency, which gave alpha
};

/// [prestress]: a case of static results whose stress stiffens the part.
struct Prestress {
  Source source{};
  std::filesystem::path file{};
  std::string of_case{};
  double factor = 1.0;
};

/// A surface or a node set of the mesh, or a point.
struct Selection {
  std::string surface{}, node_set{}, point{};  // at most one is not empty
};

/// [[point]]: a reference node with six DoFs of its own.
struct Point {
  Source source{};
  std::string name{};
  std::string node_set{};               // of its node; or
  std::optional<Eigen::Vector3d> at{};  // [m]
  int number = 0;                       // in the deck of the mesh; 0: none
};

/// [[support]]: displacements held at zero, or at the values of a [[load]].
struct Support {
  Source source{};
  std::string name{};
  Selection selection{};
  std::vector<int> directions = {0, 1, 2};  // of the system; 3 ... 5: rotations of a point
  std::string system{};                     // name, or empty: basic
};

/// Nodes and points of a coupling or node set, also [[.term]] of them.
struct Members {
  Source source{};
  Selection selection{};
  std::vector<std::string> points{};
  double weight = 1.0;            // of each node; of each m2 on a surface
  std::vector<int> directions{};  // empty: those of the table above
  std::string system{};           // of the directions; [[nodes]] only
};

/// [[coupling]]: a reference node that follows a face (distributing, RBE3), or that others follow
/// (rigid, RBE2).
struct Coupling {
  Source source;
  std::string name, kind = "node";
  bool rigid = false;
  std::optional<Eigen::Vector3d> at;  // of its own reference node [m]; absent: the face's centroid
  std::string on_point;               // or a [[point]] as the reference
  Members members;
  std::vector<Members> terms;
  std::vector<int> directions = {0, 1, 2, 3, 4, 5};  // rigid: of the followers; else: reference
  std::optional<int> dofs;                           // 3 or 6, as directions
};

/// One direction of one node or point.
struct Term {
  Source source;
  Selection selection;
  int direction = 0;
  std::optional<double> coefficient;
};

/// [[equation]]: sum coefficient * u = 0; the first term depends on the others.
struct Equation {
  Source source;
  std::vector<Term> terms;
};

/// [[spring]]: elongation = sum coefficient * u, restoring force = stiffness * elongation.
struct Spring {
  Source source;
  std::string name;
  double stiffness = 0.0;  // [N/m]; of rotations [N m/rad]
  std::vector<Term> terms;
  double loss_factor = 0.0;
};

/// [[matrix]]: stiffness or mass between DoFs, beside the cells.
struct Matrix {
  Source source;
  std::string name;
  std::vector<Term> terms;   // one per row, without coefficients
  std::vector<double> K, M;  // one of them: lower triangle by rows [N/m, N, N m], [kg, kg m, kg m2]
  double loss_factor = 0.0;  // of K
};

/// A section of a beam about its centroid, y and z across it.
struct BeamSection {
  Source source{};
  double at = 0.0;                       // share of the length from the first point
  double area = 0.0;                     // [m2]
  double I1 = 0.0, I2 = 0.0, I12 = 0.0;  // int y^2, z^2, y z dA [m4]
  double J = 0.0;                        // torsion [m4]
  double line_mass = 0.0;                // beside the material's [kg/m]
};

/// [[beam]]: a straight beam between two points (Timoshenko), with or without bending.
struct Beam {
  Source source{};
  std::string name{};
  std::vector<std::string> points{};  // two
  double E = 0.0, G = 0.0;            // [Pa]
  double rho = 0.0;                   // [kg/m3]
  double loss_factor = 0.0;
  std::vector<double> shear_factors{};  // k of k G A along y, z; empty: rigid in shear
  std::optional<Eigen::Vector3d> y{};   // a direction in the plane of x and y
  std::optional<Eigen::Vector3d> offset_a{}, offset_b{};  // of its ends from the points [m]
  std::vector<int> released_a{}, released_b{};            // along its axes
  std::vector<BeamSection> sections{};

  bool has_mass() const {
    return std::ranges::any_of(sections, [this](const BeamSection& section) {
      return rho * section.area + section.line_mass > 0.0;
    });
  }
};

/// [[straight_edges]]: mid-side nodes that move with the mean of the two ends of their edge.
struct StraightEdges {
  Source source;
  std::string node_set;
};

/// [[tie]] and [[bolt]]: a slave surface that follows a master surface; or of a tie the edge of a
/// sheet.
struct Tie {
  Source source;
  std::string name, slave, master;
  std::optional<double> distance;  // largest gap [m]; absent: a tenth of the mean slave face
                                   // size, or half the sheet's thickness
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // of a bolt: from slave to master
  std::string edge = {};                                 // instead of slave: a node set
};

/// [[gasket]]: an elastic layer between the surfaces of a tie.
struct Gasket : Tie {
  double normal = 0.0, tangential = 0.0;  // stiffnesses per area [N/m3]
  double loss_factor = 0.0;
  std::vector<double> closure{}, pressure{};  // curve of loading, for statics [m], [Pa]
  std::filesystem::path pressed{};            // static results that say where it is pressed
  std::string pressed_case{};
};

/// [[contact]]: a grid of patches on a cylinder surface.
struct Contact {
  struct Sector {
    double centre = 0.0, half_width = 0.0;  // [rad]
    int strips = 1;
  };
  Source source;
  std::string name, surface;
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();   // [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();        // unit vector
  Eigen::Vector3d zero_angle = Eigen::Vector3d::UnitY();  // unit vector
  std::vector<Sector> sectors;
  std::optional<std::pair<double, double>> axial;  // [m]
  int rows = 0;
};

/// [[mean]]: mean displacement of a face along a direction.
struct Mean {
  Source source;
  std::string name, surface;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  std::optional<std::pair<double, double>> range;  // along the direction [m]
};

/// [[sensor]]: the node of a surface nearest to a point.
struct Sensor {
  Source source;
  std::string name, surface;
  Eigen::Vector3d near = Eigen::Vector3d::Zero();  // [m]
};

/// [[nodes]]: nodes and points with all their DoFs, or some.
struct Nodes {
  Source source;
  std::string name;
  Members members;
  std::vector<Members> terms;
};

/// [[point_mass]] on a reference node, a point or plain nodes.
struct PointMass {
  Source source;
  std::string on;
  double mass = 0.0;                                 // [kg]
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // of its centre from the node [m]
  std::vector<double> inertia;  // about its centre: xx, yy, zz, or also xy, yz, zx [kg m2]
};

/// [[surface_mass]]: mass on a surface that adds no stiffness.
struct SurfaceMass {
  Source source;
  std::string surface;
  double area_mass = 0.0;  // [kg/m2]
};

/// [[heat]]: boundary conditions and sources of a steady temperature field.
struct Heat {
  /// Where the values of a list lie.
  struct Positions {
    Eigen::Vector3d along = Eigen::Vector3d::Zero();  // unit vector
    std::vector<double> at;                           // along . x, ascending [m]
  };
  /// Of a fluid at a surface. One value each, or one for each position, or a CSV file of points.
  struct Film {
    Source source;
    std::string surface;
    std::vector<double> coefficient, temperature;  // [W/(m2 K)], [K]
    Positions positions;
    std::filesystem::path table;
  };
  struct Flux {
    Source source;
    std::string surface;
    std::vector<double> flux;  // into the part [W/m2]
    Positions positions;
    std::filesystem::path table;
  };
  struct Fixed {
    Source source;
    Selection selection;
    double temperature = 0.0;  // [K]
  };
  struct HeatSource {
    Source source;
    std::vector<std::string> regions;  // empty: all
    double power = 0.0;                // [W/m3]
  };
  struct Conductance {
    Source source;
    std::string tie;           // a [[tie]] or [[bolt]]
    double conductance = 0.0;  // [W/(m2 K)]
  };
  Source source;
  std::string name;
  std::vector<Film> films;
  std::vector<Flux> fluxes;
  std::vector<Fixed> fixed;
  std::vector<HeatSource> sources;
  std::vector<Conductance> contacts;  // of the other ties both sides have the same temperature
};

/// [[load]]: a unit load case.
struct Load {
  enum class Kind {
    kPressure,
    kResultant,
    kForce,
    kAcceleration,
    kCentrifugal,
    kDisplacement,
    kNodal,
    kTemperature
  };
  Source source;
  std::string name, unit;
  Kind kind = Kind::kPressure;
  Selection selection;                               // pressure, resultant, displacement
  std::optional<Eigen::Vector3d> direction;          // of a resultant or acceleration
  double total = 1.0;                                // resultant [N]
  std::optional<Eigen::Vector3d> at;                 // resultant: the centre [m] if it is spread
  std::optional<double> radius;                      // around it, and how far [m]
  std::string set;                                   // force: a set or point
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // [N] per unit
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // [N m] per unit
  fe::RotationAxis axis;                             // centrifugal
  std::vector<int> directions;                       // displacement, of the system
  std::string system;
  std::optional<double> value;          // displacement [m], rotation [rad], temperature rise [K]
  std::vector<std::string> regions;     // that rotate; empty: all, and point masses
  std::map<std::string, double> rises;  // of regions [K]
  std::string field;            // of the mesh: n x 3 [N] or [m/s2], times `scale`; n x 1 [K]
  std::string heat;             // a [[heat]] with the temperatures
  std::filesystem::path table;  // CSV file of points: pressures or temperatures
  double reference_temperature = 293.15;  // of heat and table [K]
  double reference = 0.0;                 // of a field [K]
  double scale = 1.0;
};

/// [[case]]: a sum of loads.
struct Case {
  Source source{};
  std::string name{};
  std::map<std::string, double> factors{};  // of loads
};

/// The whole file.
struct File {
  Source source;
  double metre = 1.0;  // unit of lengths without one in the file, and of its CSV files [m]
  std::map<std::string, fe::AxesTable> systems;
  std::map<std::string, RegionMaterial> materials;
  std::vector<Shell> shells;
  std::optional<MatrixFiles> matrix_files;  // which are read elsewhere
  std::vector<Part> parts;
  Mass mass;
  Damping damping;
  std::optional<Prestress> prestress;
  std::vector<Point> points;
  std::vector<Support> supports;
  std::vector<Coupling> couplings;
  std::vector<Equation> equations;
  std::vector<Spring> springs;
  std::vector<Beam> beams;
  std::vector<Matrix> matrices;
  std::vector<StraightEdges> straight_edges;
  std::vector<Tie> ties, bolts;
  std::vector<Gasket> gaskets;
  std::vector<Contact> contacts;
  std::vector<Mean> means;
  std::vector<Sensor> sensors;
  std::vector<Nodes> nodes;
  std::vector<PointMass> point_masses;
  std::vector<SurfaceMass> surface_masses;
  std::vector<Heat> heats;
  std::vector<Load> loads;
  std::vector<Case> cases;
};

/// Their keys. What needs the mesh is checked by clatter-assembly.
const keys::Keys<File>& file_keys();
const keys::Keys<MatrixFiles>& matrix_files_keys();

}  // namespace clatter::recipe
