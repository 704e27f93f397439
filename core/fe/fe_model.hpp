// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The assembled model of one part and its file, schema "clatter/fe/2":
//   M, K, loss (symmetric, lower), T (sparse groups), nodes, rigid, attributes alpha and beta of
//   group `damping`, sets/, grids/, loads/<name> with attribute `unit`, surfaces/<name>/<face
//   type>, mass/, data for statics (fe_statics_file.hpp), and the cells (fe_cells.hpp).
#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>

#include "core/base/h5_file.hpp"
#include "core/base/sparse.hpp"
#include "core/fe/fe_cells.hpp"
#include "core/fe/fe_gasket.hpp"
#include "core/mesh/mesh.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::fe {

inline constexpr const char* kFeSchema = "clatter/fe/2";

/// Supported DoFs: coordinates s that are zero or prescribed, in addition to q. With them
///   u = T q + T_s s,   K q + K_sq^T s = f,   K_sq q + K_ss s = f_s + reactions.
struct FeSupports {
  std::vector<std::string> names;  // of supports
  std::vector<int32_t> support;    // n_s: index into names
  rom::DofSet set;                 // n_s entries: labels, positions, directions; kind "support"
  SparseMatrix T;                  // T_s, 3 n_nodes x n_s
  SparseMatrix K_sq;               // n_s x n [N/m]
  SparseMatrix K_ss;               // n_s x n_s, lower triangle [N/m]
  SparseMatrix M_sq;               // n_s x n [kg]; no entries in files of older versions
  Eigen::MatrixXd rigid;           // n_s x 6: s of unit rigid-body motions

  int size() const { return static_cast<int>(support.size()); }
};

/// Reference points: rows 6 p + d (x y z rx ry rz) of the transformations.
struct FePoints {
  std::vector<std::string> names;
  RowMatrix position;  // n_points x 3 [m]
  SparseMatrix T;      // 6 n_points x n
  SparseMatrix T_s;    // 6 n_points x n_s
};

/// Rotations of the nodes of shells: rows 3 k + d (rx ry rz) of the transformations for node k of
/// the list.
struct FeRotations {
  std::vector<int32_t> nodes;  // ascending
  SparseMatrix T;              // 3 nodes x n
  SparseMatrix T_s;            // 3 nodes x n_s
};

/// What is known of a reduced part in a model.
struct FePart {
  std::string name;
  bool certified = false;
  double valid_to_hz = 0.0;
  double accurate_to_hz = 0.0;  // by itself
  /// n x n, lower triangle: its ReducedModel::truncation on the DoFs of the model; 0 x 0 where it
  /// is not known.
  SparseMatrix truncation{};
};

/// The reduced parts in a model.
struct FeParts {
  std::vector<FePart> list{};
  IndexMatrix sheet{};  // faces of their skins that are sheet, f x 6 nodes of the model

  bool certified() const;         // each of them
  double valid_to_hz() const;     // the least of them; infinite without parts
  double accurate_to_hz() const;  // likewise
};

/// A steady temperature field.
struct HeatField {
  Eigen::VectorXd temperature;          // n_nodes [K]
  std::vector<std::string> boundaries;  // "film crown", "flux ...", "fixed ...", "source ..."
  Eigen::VectorXd heat;                 // into the part through each of them [W]
  double balance = 0.0;                 // |sum of heat| over the heat that flows
};

/// The linear elastic model of one part after elimination of couplings and supports:
///   M q'' + (alpha K + beta M) q' + K q = f,   u = T q.
/// q holds nodal displacements [m] and generalised coordinates that replace pivot displacements:
/// displacement [m] or rotation [rad] of a reference node, mean displacement of a patch or bore
/// [m]. The force on a generalised coordinate is a force [N] or moment [N m].
struct FeModel {
  std::string name;
  SparseMatrix M;  // n x n, lower triangle [kg, or kg m2 on rotations]
  SparseMatrix K;  // n x n, lower triangle [N/m]
  /// n x n, lower triangle: sum of loss factors times stiffnesses, the imaginary part of a complex
  /// stiffness [N/m]; 0 x 0 where nothing has a loss factor.
  SparseMatrix loss{};
  SparseMatrix T;   // 3 n_nodes x n: row 3 a + d is node a, direction d
  RowMatrix nodes;  // n_nodes x 3 [m]
  Eigen::MatrixXd
      rigid;            // n x 6: q of unit rigid-body motions x, y, z, rx, ry, rz about the origin
  FeSupports supports;  // supported DoFs
  FePoints points;
  FeRotations rotations;
  double alpha = 0.0;                                    // D = alpha K + beta M [s]
  double beta = 0.0;                                     // [1/s]
  std::map<std::string, rom::DofSet> sets;               // named DoFs: contacts, bearings, sensors
  std::map<std::string, rom::ContactGrid> grids;         // key: name of their set
  std::map<std::string, Eigen::VectorXd> loads;          // n, forces of unit load cases
  std::map<std::string, Eigen::VectorXd> support_loads;  // n_s: forces of the loads on s
  std::map<std::string, Eigen::VectorXd>
      prescribed;  // n_s: s of loads with prescribed displacements
  std::map<std::string, Eigen::VectorXd> temperature_rise;     // n_nodes [K], of temperature loads
  std::map<std::string, HeatField> heat;                       // temperature fields by name
  std::map<std::string, std::map<std::string, double>> cases;  // factors of loads
  std::vector<FeGasket> gaskets{};                             // with curves, for statics
  std::map<std::string, mesh::Surface> surfaces;               // outward
  FeCells cells;                                               // for stresses
  rom::MassProperties mass;                                    // of elements and point masses
  FeParts parts{};                                             // none of a mesh alone
  DeckOrigin deck{};                                           // the deck of the mesh
  std::map<std::string, std::string> load_units;               // "gas" -> "Pa": unit of the load

  int size() const { return static_cast<int>(K.rows()); }
  const rom::DofSet& set(
      const std::string& set_name) const;  // InputError listing the existing names
};

/// InputError naming the supports when they hold every DoF; `what` is the operation that needs free
/// DoFs ("modes").
void require_unknowns(const FeModel& model, const std::string& what);

/// Writes `model` into an open file; provenance, timing and certificate are the caller's.
void write_fe_model(H5File& file, const FeModel& model);

/// Reads a model; checks schema, shapes, index ranges, finite values, a positive diagonal of M and
/// K, and that every DoF of a set exists. n is 0 where supports hold every DoF.
/// InputError names the file, dataset, found and expected.
/// @param matrices kLeftOut: K and M have their shape and no entries, for programs that read them
/// in parts; loss is read.
enum class FeMatrices { kRead, kLeftOut };
FeModel read_fe_model(const std::filesystem::path& path, FeMatrices matrices = FeMatrices::kRead);

}  // namespace clatter::fe
