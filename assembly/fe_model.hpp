#pragma once
// The assembled model of one part and its file, schema "clatter/fe/2":
//   M, K (symmetric, lower), T (sparse groups), nodes, rigid, attributes alpha and beta of group
//   `damping`, sets/, grids/, loads/<name> with attribute `unit`, surfaces/<name>/<face type>,
//   mass/.
#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>

#include "core/h5_file.hpp"
#include "core/reduced_model.hpp"
#include "core/sparse.hpp"
#include "mesh/mesh.hpp"

namespace clatter::assembly {

inline constexpr const char* kFeSchema = "clatter/fe/2";

/// The linear elastic model of one part after its couplings and supports were eliminated:
///   M q'' + (alpha K + beta M) q' + K q = f,   u = T q.
/// q holds nodal displacements [m] and the generalised coordinates that took the place of pivot
/// displacements: displacement [m] or rotation [rad] of a reference node, mean displacement of a
/// patch or bore [m]. The force on a generalised coordinate is a force [N] or moment [N m].
struct FeModel {
  std::string name;
  SparseMatrix M;         // n x n, lower triangle [kg, or kg m2 on rotations]
  SparseMatrix K;         // n x n, lower triangle [N/m]
  SparseMatrix T;         // 3 n_nodes x n: row 3 a + d is node a, direction d
  RowMatrix nodes;        // n_nodes x 3 [m]
  Eigen::MatrixXd rigid;  // n x 6: q of unit rigid motions x, y, z, rx, ry, rz about the origin
  double alpha = 0.0;     // D = alpha K + beta M [s]
  double beta = 0.0;      // [1/s]
  std::map<std::string, DofSet> sets;             // what stays visible: contacts, bearings, sensors
  std::map<std::string, ContactGrid> grids;       // keyed like their set
  std::map<std::string, Eigen::VectorXd> loads;   // n, forces of unit load cases
  std::map<std::string, mesh::Surface> surfaces;  // outward
  MassProperties mass;                            // of the elements and point masses
  std::map<std::string, std::string> load_units;  // "gas" -> "Pa": what one unit of the load is

  int size() const { return static_cast<int>(K.rows()); }
  const DofSet& set(const std::string& set_name) const;  // InputError listing the names present
};

/// Writes `model` into an open file; provenance, timing and certificate are the caller's.
void write_fe_model(H5File& file, const FeModel& model);

/// Reads a model; checks schema, shapes, index ranges, finite values, a positive diagonal of M and
/// K, and that every DoF of a set exists. InputError names the file, place, found and expected.
FeModel read_fe_model(const std::filesystem::path& path);

}  // namespace clatter::assembly
