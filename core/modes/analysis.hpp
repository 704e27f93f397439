#pragma once
// The modes of one part, assembled or reduced, with their shapes at the nodes.
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "core/fe/fe_model.hpp"
#include "core/rom/reduced_model.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"

namespace clatter::modes {

/// The `.modes.toml`, or the command line; defaults stand here.
struct ModesOptions : sparse::EigenChoice {
  int count = 0;                   // lowest modes, or
  double fmax_hz = 0.0;            // all modes below; neither: the 20 lowest
  std::vector<std::string> fixed;  // sets that are clamped; none: as assembled
  bool prove_count = true;
};

/// Reads the options; InputError for unknown keys and senseless values.
ModesOptions read_modes_options(const Config& config);

/// Modes with what makes shapes of them: those of many modes are twice the vectors' memory, so that
/// they are made some at a time.
struct PartModes {
  std::string name;
  std::string source;  // "fe" or "rom"
  sparse::ModeSet modes;
  RowMatrix nodes;  // n x 3 [m]: all nodes of an FE model, the skin of a reduced one
  std::map<std::string, mesh::Surface> surfaces;  // on `nodes`
  /// u = T q of some vectors q.
  std::function<Eigen::MatrixXd(const Eigen::Ref<const Eigen::MatrixXd>& q)> displacements;

  /// Of modes [first, first + count), 3 n x count: row 3 a + d is node a, direction d; unit modal
  /// mass.
  Eigen::MatrixXd shapes(Eigen::Index first, Eigen::Index count) const {
    return displacements(modes.vectors.middleCols(first, count));
  }
};

/// Modes of an assembled part, which must outlive them; clamped DoFs are taken out of M and K.
/// InputError for an unknown set.
PartModes analyse(const fe::FeModel& model, const ModesOptions& options);

/// Modes of a reduced part, which must outlive them, by dense algebra; shapes on its skin.
PartModes analyse(const rom::ReducedModel& model, const ModesOptions& options);

/// Rows and columns `kept` (ascending) of a symmetric matrix given by its lower triangle.
SparseMatrix principal_submatrix(const SparseMatrix& lower, const std::vector<int32_t>& kept);

/// "mode  frequency [Hz]  residual" line by line, with the proof below.
std::vector<std::string> describe(const PartModes& part);

}  // namespace clatter::modes
