// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A condensed elastic body, eq. (13) and (14): output of condense, input of dynamics and recover.
//
//   M_rr q'' + D_rr q' + K_rr q = f_r,   D_rr = alpha K_rr + beta M_rr + D_table,
//   u_skin = T_skin q,   D_table by damping_table.hpp
//
// q = [boundary coordinates q_b; modal coordinates q_k]. A boundary coordinate is a displacement
// [m] or rotation [rad] of a named point: a sensor, a mount, a bearing centre, or the mean radial
// displacement of one patch of a contact grid. Its conjugate force is a force [N], a moment [N m],
// or the resultant of the pressure on the patch.
#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/artefact.hpp"
#include "core/base/deck_origin.hpp"
#include "core/base/h5_file.hpp"
#include "core/rom/damping_table.hpp"
#include "core/rom/elimination_order.hpp"
#include "core/rom/inertia_invariants.hpp"
#include "core/rom/reduced_certificate.hpp"

namespace clatter::rom {

inline constexpr const char* kRomSchema = "clatter/rom/1";

/// A named group of DoFs, each with a position and a direction.
struct DofSet {
  std::string kind;           // "node", "bearing", "mount", "sensor", "contact_grid", "mean"
  std::vector<int32_t> dofs;  // indices into the model's coordinates (FE: n, reduced: dof_count())
  std::vector<std::string> labels;    // one per DoF: "sensor_block.y", "liner_4[3,7]"
  Eigen::MatrixXd position;           // dofs x 3 [m]
  Eigen::MatrixXd direction;          // dofs x 3, unit vectors
  std::vector<int32_t> is_rotation;   // 1: rotation about `direction`, 0: displacement along it
  std::vector<int32_t> node_ids{};    // node numbers in the deck of the mesh, 0: none; or empty
  std::vector<int32_t> components{};  // 1 to 6 along and about axes of the node's own in the deck,
                                      // 0: `direction` is x, y, z or none of a deck; or empty
  std::map<std::string, IndexMatrix> faces{};  // by type ("tri6"): faces of the FE model between
                                               // nodes of the set, outward (nodes_of_set())
  bool sheet = false;                          // these are faces of shells, which have two sides
};

/// The nodes of a set, to which DofSet::faces refer: the first DoF of each run of DoFs at one
/// position.
std::vector<int32_t> nodes_of_set(const DofSet& set);

/// A grid of patches on a cylinder surface (liner bore or piston skirt). Patch (i, j) is DoF
/// i * axial.size() + j of the set of the same name; its coordinate is the area-weighted mean
/// radial displacement, positive away from the axis.
struct ContactGrid {
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();       // unit vector
  Eigen::Vector3d zero_angle =
      Eigen::Vector3d::UnitX();  // direction of angle 0, right-handed about axis
  double radius = 0.0;           // [m]
  Eigen::VectorXd angle;        // patch centres [rad], ascending; may cover only part of the circle
  Eigen::VectorXd axial;        // patch centres along the axis from axis_point [m], ascending
  Eigen::VectorXd angle_edges;  // pairs (begin, end) per angular strip, 2 x angle.size() [rad]
  Eigen::VectorXd axial_edges;  // axial.size() + 1 [m]
};

/// Mass properties about the origin of the part's frame.
struct MassProperties {
  double mass = 0.0;                                  // [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   // [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre of mass [kg m2]
};

/// The skin of a body and the rows of its recovery matrix.
struct Skin {
  RowMatrix nodes;        // n_s x 3 [m]
  IndexMatrix triangles;  // n_f x 6, quadratic triangles, outward orientation, Gmsh order
  RowMatrix T{};          // 3 n_s x r, row 3 a + d: node a, direction d
  std::vector<std::string> surfaces{};  // of the FE model, merged into this skin
  /// Rows of `triangles` that lie on each named surface of the FE model, ascending. Surfaces that
  /// are not part of the skin are absent; all are in files of older versions.
  std::map<std::string, std::vector<int32_t>> faces{};
  std::vector<int32_t> sheet{};  // rows of `triangles` that are shells, ascending
};

struct ReducedModel {
  std::string name;
  std::string method;          // "guyan", "craig-bampton", "craig-chang"
  int n_boundary = 0;          // first n_boundary coordinates
  Eigen::MatrixXd M_rr, K_rr;  // r x r, symmetric, both triangles filled [SI]
  double alpha = 0.0;          // stiffness-proportional damping [s]
  double beta = 0.0;           // mass-proportional damping [1/s]
  DampingTable modal_damping;  // added to both
  /// r x r or empty: the imaginary part of a complex stiffness [N/m], whose damping of each mode is
  /// added too: q^T loss q / omega [1/s] for a mode q of unit modal mass.
  Eigen::MatrixXd loss{};
  Eigen::MatrixXd
      rigid;  // r x 6: q of unit rigid-body motions x, y, z, rx, ry, rz about the origin
  /// r x 6: inertia forces on q of unit accelerations of the part's frame, V^T (M R + M_qs R_s), of
  /// a part with supports, whose basis V does not contain the rigid motions R; 0 rows for free
  /// parts, where they are M_rr rigid.
  Eigen::MatrixXd inertia_force{};
  std::map<std::string, DofSet> sets;        // boundary sets
  std::map<std::string, ContactGrid> grids;  // contact grids, key: name of their set
  std::map<std::string, Eigen::VectorXd>
      loads;                           // r; reduced load vectors of unit load cases ("gas": per Pa)
  MassProperties mass;                 // of the full model
  Eigen::VectorXd fixed_interface_hz;  // frequencies of the kept modes
  double valid_to_hz = 0.0;            // highest frequency that the basis is intended for
  /// r x r or empty: a mode q of unit modal mass and value lambda of an assembly in which the part
  /// stands is too high by lambda / 2 q^T truncation q of its frequency, for what the basis lacks.
  Eigen::MatrixXd truncation{};
  Skin skin;                  // empty (0 rows) when not recovered
  InertiaInvariants inertia;  // of a rotating body; empty unless requested
  /// c x r, DoFs whose displacement is a combination of coordinates: those that became so when the
  /// interface was reduced, then those of recovered_sets. An index r + j in DofSet::dofs is the
  /// displacement combined.row(j) q.
  Eigen::MatrixXd combined;
  std::vector<std::string> recovered_sets;  // sets that were never coordinates
  EliminationOrder elimination;             // of K_ii; read_reduced_model leaves it empty
  ReducedCertificate certificate;
  DeckOrigin deck{};  // the deck of the mesh

  int size() const { return static_cast<int>(M_rr.rows()); }
  /// Number of coordinates plus rows of `combined`: the range of DofSet::dofs.
  int dof_count() const { return size() + static_cast<int>(combined.rows()); }
  /// The displacement of DoF `dof` < dof_count() as a row of r coefficients of q.
  Eigen::RowVectorXd row_of(int dof) const;
  /// Viscous damping rates 2 zeta omega [1/s] of modes q (columns of `modes`, unit modal mass) with
  /// these omega^2 [1/s2]: alpha omega^2 + beta, modal_damping, and q^T loss q / omega, which gives
  /// the loss factor at the mode's own frequency (modal strain energy, Johnson and Kienholz 1982).
  Eigen::VectorXd damping_rates(const Eigen::VectorXd& omega_squared,
                                const Eigen::MatrixXd& modes) const;
  const DofSet& set(const std::string& set_name) const;  // InputError listing the existing names
  const ContactGrid& grid(
      const std::string& grid_name) const;  // InputError listing the existing names
};

/// Writes `model` under kRomSchema into an open file (provenance and timing are left to
/// the caller's).
void write_reduced_model(H5File& file, const ReducedModel& model);
/// Reads and checks shapes, ranges, symmetry, finite values (InputError). `with_skin` false leaves
/// the skin empty.
ReducedModel read_reduced_model(const std::filesystem::path& path, bool with_skin = true);

/// Reads and checks the skin without its recovery rows: `T` stays empty (0 rows), skin_rows.hpp
/// reads it. Empty when the file has no skin.
Skin read_skin_geometry(const std::filesystem::path& path);

/// DoF sets and grids are stored in the same way by FE models and reduced models.
void write_dof_sets(H5File& file, const std::map<std::string, DofSet>& sets,
                    const std::map<std::string, ContactGrid>& grids);
void read_dof_sets(const H5File& file, int n_dofs, std::map<std::string, DofSet>& sets,
                   std::map<std::string, ContactGrid>& grids);
void write_mass_properties(H5File& file, const MassProperties& mass);
MassProperties read_mass_properties(const H5File& file);

}  // namespace clatter::rom
