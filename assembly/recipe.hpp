#pragma once
// What a part's fe.toml says. assembly/README.md shows the file; lengths are in metres here.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assembly/contact_patch.hpp"
#include "assembly/material.hpp"
#include "core/config.hpp"
#include "mesh/mesh.hpp"

namespace clatter::assembly {

/// [damping]: D = alpha K + beta M.
struct DampingSpec {
  double alpha = 0.0;  // [s]
  double beta = 0.0;   // [1/s]
};

/// A surface or a node set of the mesh.
struct Place {
  std::string surface, node_set;  // one of them is empty
  std::string where;              // for messages: "file:line: table"
};

/// [[support]]: displacements held at zero.
struct SupportSpec {
  Place place;
  std::vector<int> directions = {0, 1, 2};
};

/// [[coupling]]: a reference node that rides on a face (RBE3).
struct CouplingSpec {
  std::string name, kind, surface, where;
  std::optional<Eigen::Vector3d> point;  // absent: the face's centroid
  int dofs = 6;                          // 6 or 3
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

/// [[point_mass]] on a reference node or plain nodes.
struct PointMassSpec {
  std::string on, where;
  double mass = 0.0;                                  // [kg]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the node [kg m2]
};

/// [[load]]: a unit load case.
struct LoadSpec {
  enum class Kind { kPressure, kResultant, kForce, kGravity };
  std::string name, unit, where;
  Kind kind = Kind::kPressure;
  std::string surface, set;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // [N] per unit; gravity: unit vector
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // [N m] per unit
};

struct Recipe {
  std::vector<Material> materials;  // one a region of the mesh
  DampingSpec damping;
  std::vector<SupportSpec> supports;
  std::vector<CouplingSpec> couplings;
  std::vector<ContactSpec> contacts;
  std::vector<MeanSpec> means;
  std::vector<NodeSpec> nodes;
  std::vector<PointMassSpec> point_masses;
  std::vector<LoadSpec> loads;
};

/// Reads and checks the whole file against the mesh; InputError with "file:line: key: found ...,
/// expected ..." for unknown keys, regions, surfaces, sets, double names, values out of range.
Recipe read_recipe(const Config& config, const mesh::Mesh& mesh);

}  // namespace clatter::assembly
