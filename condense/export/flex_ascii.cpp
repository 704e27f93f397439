// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/flex_ascii.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "condense/export/pencil_modes.hpp"
#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/base/named.hpp"
#include "core/base/whole_file.hpp"
#include "core/dense/cholesky.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Coordinates of a set along and about x, y, z at one position; -1 where it has none.
std::array<Index, 6> six_of(const rom::DofSet& set, const std::vector<rom::MappedDof>& map) {
  std::array<Index, 6> six{-1, -1, -1, -1, -1, -1};
  for (size_t k = 0; k < set.dofs.size(); ++k) {
    const int component = map[set.dofs[k]].component;
    const bool here = set.position.row(static_cast<Index>(k)) == set.position.row(0);
    if (component > 0 && here) six[component - 1] = set.dofs[k];
  }
  return six;
}

bool complete(const std::array<Index, 6>& six) {
  return std::none_of(six.begin(), six.end(), [](Index j) { return j < 0; });
}

std::array<Index, 6> interface_of(const ExportedPart& part) {
  const rom::ReducedModel& model = part.model;
  const std::string& wanted = part.options.interface;
  std::vector<std::string> names;
  for (const auto& [name, set] : model.sets)
    if (complete(six_of(set, part.map))) names.push_back(name);
  if (!wanted.empty()) find_named(model.sets, model.name, "set", wanted);
  const bool found = std::find(names.begin(), names.end(), wanted) != names.end();
  if (wanted.empty() ? names.size() == 1 : found)
    return six_of(model.set(wanted.empty() ? names[0] : wanted), part.map);
  throw InputError(fmt::format(
      "{}: interface of OpenFAST: found {}, expected one set with x, y, z, rx, ry, rz of one point "
      "(--interface SET); sets with these six: {}",
      model.name, wanted.empty() ? fmt::format("{} sets", names.size()) : '"' + wanted + '"',
      names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

/// q = [I 0; Psi Phi] (b, modes), Psi the static motion of the others and Phi their modes with b
/// held.
MatrixXd craig_bampton_of(const rom::ReducedModel& model, const std::array<Index, 6>& six) {
  std::vector<Index> rest;
  for (Index j = 0; j < model.size(); ++j)
    if (std::find(six.begin(), six.end(), j) == six.end()) rest.push_back(j);
  const auto n = static_cast<Index>(rest.size());
  MatrixXd W = MatrixXd::Zero(model.size(), 6 + n);
  for (Index d = 0; d < 6; ++d) W(six[d], d) = 1.0;
  if (n == 0) return W;
  const MatrixXd K_ii = model.K_rr(rest, rest), M_ii = model.M_rr(rest, rest);
  const dense::Cholesky factor(K_ii);
  if (!factor.ok())
    throw InputError(fmt::format(
        "{}: found a part that moves freely with its interface held, expected one that it holds",
        model.name));
  W(rest, Eigen::seqN(0, 6)) = -factor.solve(model.K_rr(rest, six));
  W(rest, Eigen::seqN(6, n)) = dense::symmetric_eigen(K_ii, M_ii).vectors;
  return W;
}

void write_matrix(std::ostream& out, const char* head, const MatrixXd& matrix) {
  out << fmt::format("!{}\n!Dimension: {}\n", head, matrix.rows());
  for (Index i = 0; i < matrix.rows(); ++i) {
    for (Index j = 0; j < matrix.cols(); ++j) out << fmt::format(" {:23.16E}", matrix(i, j));
    out << '\n';
  }
  out << '\n';
}

/// W^T A W; blocks between interface and modes of K are zero but for rounding.
MatrixXd projected(const MatrixXd& A, const MatrixXd& W) {
  const MatrixXd out = W.transpose() * A * W;
  return 0.5 * (out + out.transpose());
}

}  // namespace

void export_flex_ascii(const ExportedPart& part, const std::filesystem::path& path) {
  const rom::ReducedModel& model = part.model;
  const MatrixXd W = craig_bampton_of(model, interface_of(part));
  const Index n = W.cols();
  MatrixXd K = projected(model.K_rr, W);
  K.topRightCorner(6, n - 6).setZero();
  K.bottomLeftCorner(n - 6, 6).setZero();
  constexpr double kEnd = 10'000.0;  // [s] two instants, as long as any simulation
  WholeFile file(path);
  std::ostream& out = file.stream();
  out << fmt::format("!clatter {}: {} ({}), {}\n", version(), model.name, model.method,
                     text_of(part.units));
  out << "!Flex 5 Format\n";
  out << fmt::format("!Dimension: {}\n!Time increment in simulation: {}\n", n, kEnd);
  out << fmt::format("!Total simulation time in file: {}\n\n", kEnd);
  write_matrix(out, "Mass Matrix (Units (kg,m))", projected(model.M_rr, W));
  write_matrix(out, "Stiffness Matrix (Units (N,m))", K);
  write_matrix(out, "Damping Matrix (Units (N,m,kg))", projected(damping_of(model), W));
  out << "!Loading and Wave Elevation (Units (N,m)): zero, replace them\n";
  out << fmt::format("!Dimension: 1 time column - {} force columns - 1 wave elevation column\n", n);
  for (const double time : {0.0, kEnd}) {
    out << fmt::format(" {:23.16E}", time);
    for (Index j = 0; j <= n; ++j) out << " 0.0";
    out << '\n';
  }
  file.commit();
}

}  // namespace clatter::condense
