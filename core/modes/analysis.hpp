// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Modes of an assembled or reduced part, with mode shapes at the nodes.
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "core/base/json_line.hpp"
#include "core/fe/fe_model.hpp"
#include "core/rom/reduced_model.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"

namespace clatter::modes {

/// Options of the `.modes.toml` or the command line, with their defaults.
struct ModesOptions : sparse::EigenChoice {
  int count = 0;                   // lowest modes, or
  double fmax_hz = 0.0;            // all modes below; neither: the 20 lowest
  std::vector<std::string> fixed;  // clamped sets; empty: as assembled
  bool prove_count = true;
};

/// The keys of a modes.toml.
const keys::Keys<ModesOptions>& modes_keys();

/// Modes and the map to mode shapes. Shapes of many modes need twice the memory of the vectors, so
/// they are computed in batches.
struct PartModes {
  std::string name;
  std::string source;  // "fe" or "rom"
  sparse::ModeSet modes;
  Eigen::VectorXd loss_factors{};    // by modal strain energy; empty where nothing has one
  std::vector<std::string> parts{};  // reduced parts in the model
  Eigen::MatrixXd part_errors{};     // modes x parts: fe::part_errors
  RowMatrix nodes;  // n x 3 [m]: all nodes of an FE model, the skin of a reduced one
  std::map<std::string, mesh::Surface> surfaces;  // of `nodes`
  /// u = T q for the columns of q.
  std::function<Eigen::MatrixXd(const Eigen::Ref<const Eigen::MatrixXd>& q)> displacements;

  /// Shapes of modes [first, first + count), 3 n x count: row 3 a + d is node a, direction d; unit
  /// modal mass.
  Eigen::MatrixXd shapes(Eigen::Index first, Eigen::Index count) const {
    return displacements(modes.vectors.middleCols(first, count));
  }
};

/// Modes of an assembled part, which must outlive them; clamped DoFs are removed from M and K.
/// InputError for an unknown set.
PartModes analyse(const fe::FeModel& model, const ModesOptions& options);

/// The modes of the DoFs `left` (ascending) of a part: all of them, or none where another process
/// receives them.
using ModeSolver = std::function<sparse::ModeSet(const std::vector<int32_t>& left,
                                                 const sparse::EigenOptions& options)>;

/// The same by another solver; K and M of the model may be left out.
PartModes analyse(const fe::FeModel& model, const ModesOptions& options, const ModeSolver& solve);

/// Modes of a reduced part, which must outlive them, by a dense solver; shapes on its skin.
PartModes analyse(const rom::ReducedModel& model, const ModesOptions& options);

/// Rows and columns `kept` (ascending) of a symmetric matrix given by its lower triangle.
SparseMatrix principal_submatrix(const SparseMatrix& lower, const std::vector<int32_t>& kept);

/// "mode  frequency [Hz]  residual" as lines, followed by the completeness proof.
std::vector<std::string> describe(const PartModes& part);

/// For --json: modes (their number), frequency_hz, rigid, count_proved (0 or 1).
JsonMembers json_of(const PartModes& part);

}  // namespace clatter::modes
