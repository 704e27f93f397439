// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/modes/analysis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>

#include "core/base/error.hpp"
#include "core/fe/free_motions.hpp"
#include "core/fe/part_errors.hpp"
#include "core/modes/factor_failure.hpp"

namespace clatter::modes {
namespace {

constexpr int kDefaultCount = 20;

sparse::EigenOptions eigen_options(const ModesOptions& options, int size) {
  sparse::EigenOptions eigen;
  eigen.fmax_hz = options.fmax_hz;
  eigen.count = options.count;
  if (options.count == 0 && options.fmax_hz == 0.0) eigen.count = std::min(kDefaultCount, size);
  eigen.prove_count = options.prove_count;
  static_cast<sparse::EigenChoice&>(eigen) = options;
  return eigen;
}

std::string why_unproved(const sparse::ModeSet& modes) {
  if (modes.errors.size() == 0) return " (prove_count = false)";
  if (modes.proof.below < 0) return " (prove_count = false, or the errors leave no gap clear)";
  return fmt::format(": inertia counts {} below {:.4f} Hz, where the errors leave it open",
                     modes.proof.below, sparse::hz_of_value(modes.proof.limit));
}

template <typename Model>
std::vector<int32_t> dofs_left(const Model& model, const std::vector<std::string>& fixed) {
  std::vector<char> held(static_cast<size_t>(model.size()), 0);
  for (const std::string& name : fixed) {
    for (const int32_t dof : model.set(name).dofs) {
      if (dof >= model.size())
        throw InputError(
            fmt::format("{}: fixed: found \"{}\", whose coordinates were replaced by interface "
                        "modes, expected a set with its own coordinates",
                        model.name, name));
      held[dof] = 1;
    }
  }
  std::vector<int32_t> left;
  for (int32_t dof = 0; dof < model.size(); ++dof) {
    if (held[dof] == 0) left.push_back(dof);
  }
  if (left.empty()) throw InputError(model.name + ": fixed: found every DoF, expected free DoFs");
  return left;
}

/// Expands vectors to all DoFs, zero where clamped; starts with the last, so that memory never
/// holds both completely.
void spread(const std::vector<int32_t>& left, Eigen::Index size, Eigen::MatrixXd& vectors) {
  constexpr Eigen::Index kColumns = 32;
  Eigen::MatrixXd all(size, vectors.cols());
  while (vectors.cols() > 0) {
    const Eigen::Index count = std::min(kColumns, vectors.cols()), first = vectors.cols() - count;
    auto columns = all.middleCols(first, count);
    columns.setZero();
    columns(left, Eigen::all) = vectors.rightCols(count);
    vectors.conservativeResize(Eigen::NoChange, first);
  }
  vectors.swap(all);
}

/// Modes of the rows `left` of a model with its known rigid-body motions; a failed factorisation
/// names the node.
sparse::ModeSet solve_named(const fe::FeModel& model, const std::vector<int32_t>& left,
                            const SparseMatrix& K, const SparseMatrix& M,
                            sparse::EigenOptions options) {
  // Matrices imported without positions have no known rigid-body motions.
  if ((model.rigid.colwise().squaredNorm().array() > 0.0).all())
    options.rigid = fe::free_motions(K, M, model.rigid(left, Eigen::all)).q;
  try {
    return sparse::solve_modes(K, M, options);
  } catch (const sparse::NotPositiveDefinite& error) {
    throw explained(model, "K - sigma M", left, error);
  }
}

/// x^T loss x / lambda of modes x of unit modal mass; 0 of rigid ones.
/// @param image loss x, n x modes.
Eigen::VectorXd loss_factors(const sparse::ModeSet& modes, const Eigen::MatrixXd& image) {
  Eigen::VectorXd factors = Eigen::VectorXd::Zero(modes.size());
  for (Eigen::Index j = modes.rigid; j < modes.size(); ++j)
    factors[j] = modes.vectors.col(j).dot(image.col(j)) / modes.values[j];
  return factors;
}

/// A frequency that rounding of K may move by all of itself has no digit (hard case F6).
void refuse_rounding(const std::string& name, const sparse::ModeSet& modes) {
  Eigen::Index worst = 0;
  if (modes.size() == 0 || modes.rounding.maxCoeff(&worst) <= 1.0) return;
  throw NumericsError(fmt::format(
      "{}: mode {} at {:.4g} Hz: found that rounding of the entries of K may move it by {:.2g} of "
      "its frequency, expected less than 1: choose cells that are less flat, or smaller jumps of "
      "stiffness",
      name, worst + 1, modes.frequencies_hz()[worst], modes.rounding[worst]));
}

}  // namespace

const keys::Keys<ModesOptions>& modes_keys() {
  static const keys::Keys<ModesOptions> keys(
      "modes.toml", "which modes of a part are computed; every key is optional",
      [](auto& key, ModesOptions& options) {
        key.integer("count", options.count, Range::between(1.0, 1e6),
                    "the lowest modes, this many; 20 with neither count nor fmax_hz");
        key.number("fmax_hz", options.fmax_hz, Range::positive(), "all modes below this frequency")
            .excludes("count");
        key.texts("fixed", options.fixed, "names of sets that are clamped in addition");
        key.flag("prove_count", options.prove_count,
                 "whether counts of eigenvalues prove that no mode is missing");
        key.part(static_cast<sparse::EigenChoice&>(options), sparse::eigen_choice_keys());
      });
  return keys;
}

SparseMatrix principal_submatrix(const SparseMatrix& lower, const std::vector<int32_t>& kept) {
  std::vector<int32_t> new_index(static_cast<size_t>(lower.cols()), -1);
  for (size_t k = 0; k < kept.size(); ++k) {
    new_index[kept[k]] = static_cast<int32_t>(k);
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(lower.nonZeros());
  for (int j = 0; j < lower.outerSize(); ++j) {
    const int column = new_index[j];
    if (column < 0) continue;
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      const int row = new_index[it.row()];
      if (row >= 0) entries.emplace_back(row, column, it.value());
    }
  }
  const auto size = static_cast<int>(kept.size());
  SparseMatrix out(size, size);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

PartModes analyse(const fe::FeModel& model, const ModesOptions& options) {
  return analyse(model, options,
                 [&](const std::vector<int32_t>& left, const sparse::EigenOptions& eigen) {
                   if (options.fixed.empty())
                     return solve_named(model, left, model.K, model.M, eigen);
                   return solve_named(model, left, principal_submatrix(model.K, left),
                                      principal_submatrix(model.M, left), eigen);
                 });
}

PartModes analyse(const fe::FeModel& model, const ModesOptions& options, const ModeSolver& solve) {
  fe::require_unknowns(model, "modes");
  PartModes part;
  part.name = model.name;
  part.source = "fe";
  part.nodes = model.nodes;
  part.surfaces = model.surfaces;
  part.displacements = [&model](const auto& q) -> Eigen::MatrixXd { return model.T * q; };
  const std::vector<int32_t> left = dofs_left(model, options.fixed);
  const sparse::EigenOptions eigen = eigen_options(options, static_cast<int>(left.size()));
  part.modes = solve(left, eigen);
  refuse_rounding(part.name, part.modes);
  if (!options.fixed.empty()) spread(left, model.size(), part.modes.vectors);
  if (model.loss.rows() > 0 && part.modes.vectors.rows() == model.size())
    part.loss_factors =
        loss_factors(part.modes, multiply_symmetric(model.loss, part.modes.vectors));
  for (const fe::FePart& one : model.parts.list) part.parts.push_back(one.name);
  if (!part.parts.empty() && part.modes.vectors.rows() == model.size())
    part.part_errors = fe::part_errors(model.parts, part.modes.values, part.modes.vectors);
  return part;
}

PartModes analyse(const rom::ReducedModel& model, const ModesOptions& options) {
  PartModes part;
  part.name = model.name;
  part.source = "rom";
  part.nodes = model.skin.nodes;
  if (model.skin.triangles.rows() > 0) {
    part.surfaces["skin"].faces = {{mesh::FaceType::kTri6, model.skin.triangles}};
  }
  const std::vector<int32_t> left = dofs_left(model, options.fixed);
  const auto size = static_cast<int>(left.size());
  sparse::EigenOptions eigen = eigen_options(options, size);
  eigen.dense_limit = size;
  const auto lower = [&](const Eigen::MatrixXd& matrix) -> SparseMatrix {
    const Eigen::MatrixXd kept = matrix(left, left);
    return Eigen::MatrixXd(kept.triangularView<Eigen::Lower>()).sparseView(0.0, 0.0);
  };
  const SparseMatrix K = lower(model.K_rr), M = lower(model.M_rr);
  eigen.rigid = fe::free_motions(model, left);
  part.modes = sparse::solve_modes(K, M, eigen);
  spread(left, model.size(), part.modes.vectors);
  if (model.loss.rows() > 0)
    part.loss_factors = loss_factors(part.modes, model.loss * part.modes.vectors);
  part.displacements = [&model](const auto& q) -> Eigen::MatrixXd { return model.skin.T * q; };
  return part;
}

namespace {

/// Fixed digits, or significant digits for low frequencies.
std::string hz_text(double hz) {
  return hz >= 0.1 || hz == 0.0 ? fmt::format("{:>12.4f}", hz) : fmt::format("{:>12.4g}", hz);
}

void describe_doubt(const sparse::ModeSet& modes, std::vector<std::string>& lines) {
  constexpr double kWorthSaying = 1e-6;
  Eigen::Index worst = 0;
  if (modes.size() > 0 && modes.rounding.maxCoeff(&worst) > kWorthSaying)
    lines.push_back(
        fmt::format("rounding of the entries of K to doubles may move frequencies by up to {:.1e} "
                    "(mode {}): thin walls or stiff jumps",
                    modes.rounding[worst], worst + 1));
  if (modes.rigid > modes.known_rigid)
    lines.push_back(
        fmt::format("{} modes are 0 Hz to rounding besides the {} rigid-body motions: mechanisms",
                    modes.rigid - modes.known_rigid, modes.known_rigid));
  if (modes.massless > 0)
    lines.push_back(fmt::format("{} DoFs have no mass: as many infinite eigenvalues are omitted",
                                modes.massless));
}

std::string loss_text(const PartModes& part, Eigen::Index mode) {
  if (part.loss_factors.size() == 0) return {};
  return fmt::format("  loss factor {:.2e}", part.loss_factors[mode]);
}

/// What the modes that reduced parts lack cost a mode.
std::string part_error_text(const PartModes& part, Eigen::Index mode) {
  if (part.part_errors.rows() == 0 || mode < part.modes.rigid) return {};
  const Eigen::RowVectorXd errors = part.part_errors.row(mode);
  if (!errors.allFinite()) return "  parts unknown";
  Eigen::Index worst = 0;
  errors.maxCoeff(&worst);
  return fmt::format("  parts {:.1e} ({})", errors.sum(), part.parts[worst]);
}

}  // namespace

std::vector<std::string> describe(const PartModes& part) {
  const sparse::ModeSet& modes = part.modes;
  const bool approximate = modes.errors.size() > 0;
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{}: {} modes ({}, {} solves), {} of them rigid", part.name,
                              modes.size(), modes.method, modes.solves, modes.rigid));
  const Eigen::VectorXd hz = modes.frequencies_hz();
  for (Eigen::Index j = 0; j < modes.size(); ++j) {
    lines.push_back(fmt::format("{:>5}  {} Hz  {} {:.1e}{}{}", j + 1, hz_text(hz[j]),
                                approximate ? "error about" : "residual",
                                approximate ? modes.errors[j] : modes.residuals[j],
                                j < modes.rigid ? "  rigid" : loss_text(part, j),
                                part_error_text(part, j)));
  }
  if (approximate)
    lines.push_back(
        fmt::format("frequencies are approximate, from above: largest error about {:.1e}",
                    modes.errors.maxCoeff()));
  describe_doubt(modes, lines);
  if (modes.proof.proved) {
    lines.push_back(fmt::format("none is missing: inertia counts {} below {:.4f} Hz",
                                modes.proof.below, sparse::hz_of_value(modes.proof.limit)));
  } else {
    lines.push_back("their number is not proved" + why_unproved(modes));
  }
  return lines;
}

JsonMembers json_of(const PartModes& part) {
  const Eigen::VectorXd hz = part.modes.frequencies_hz();
  return {{"modes", json_number(part.modes.size())},
          {"frequency_hz", fmt::format("[{}]", fmt::join(hz.data(), hz.data() + hz.size(), ", "))},
          {"rigid", json_number(part.modes.rigid)},
          {"count_proved", json_number(part.modes.proof.proved ? 1.0 : 0.0)}};
}

}  // namespace clatter::modes
