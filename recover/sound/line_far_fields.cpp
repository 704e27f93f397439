// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/line_far_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "core/sound/complex_lu.hpp"
#include "core/sound/far_harmonics.hpp"

namespace clatter::recover {
namespace {

constexpr Eigen::Index kLinesAtOnce = 256;

/// The lines of one piece that are interpolated from one sample of the table.
struct SampleLines {
  std::vector<Eigen::Index> lines{};
  std::vector<double> weight{};  // of power_stencil()
  size_t size() const { return lines.size(); }
};

/// Flows of the parts in some lines, n_v x (lines x parts), part by part of each line.
Eigen::MatrixXcd part_flows(const LineSpectrum& velocity, Eigen::Index first, Eigen::Index count,
                            const std::vector<RowMatrix>& flows) {
  const auto parts = static_cast<Eigen::Index>(flows.size());
  Eigen::MatrixXd v(velocity.amplitude.cols(), 2 * count);
  v << velocity.amplitude.middleRows(first, count).real().transpose(),
      velocity.amplitude.middleRows(first, count).imag().transpose();
  Eigen::MatrixXcd out(parts > 0 ? flows.front().rows() : 0, count * parts);
  for (Eigen::Index p = 0; p < parts; ++p) {
    const Eigen::MatrixXd product = flows[p] * v;
    for (Eigen::Index k = 0; k < count; ++k) {
      out.col(k * parts + p).real() = product.col(k);
      out.col(k * parts + p).imag() = product.col(count + k);
    }
  }
  return out;
}

std::vector<SampleLines> lines_of_samples(const SoundTable& table, const LineSpectrum& velocity,
                                          Eigen::Index first, Eigen::Index count) {
  std::vector<SampleLines> out(table.samples.size());
  for (Eigen::Index k = first; k < first + count; ++k) {
    if (!(velocity.frequency_hz[k] > 0.0)) continue;  // a motion at 0 Hz radiates nothing
    const Stencil by = power_stencil(table, velocity.frequency_hz[k]);
    for (Eigen::Index i = 0; i < by.weight.size(); ++i) {
      out[by.first + static_cast<size_t>(i)].lines.push_back(k);
      out[by.first + static_cast<size_t>(i)].weight.push_back(by.weight[i]);
    }
  }
  return out;
}

/// |sum over parts of F|^2 in each direction, directions x lines.
Eigen::MatrixXd squares_in_directions(const Eigen::MatrixXcd& F, Eigen::Index parts,
                                      const Eigen::MatrixXd& harmonics) {
  const Eigen::Index count = F.cols() / parts;
  Eigen::MatrixXd whole(F.rows(), 2 * count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::VectorXcd sum = F.middleCols(k * parts, parts).rowwise().sum();
    whole.col(k) = sum.real();
    whole.col(count + k) = sum.imag();
  }
  const Eigen::MatrixXd p = harmonics.leftCols(F.rows()) * whole;
  return p.leftCols(count).cwiseAbs2() + p.rightCols(count).cwiseAbs2();
}

/// Adds what one sample of the table contributes to its lines.
/// @param F (degree + 1)^2 x (lines x parts) [Pa m]
void add_sample(double to_power, const LineSpectrum& velocity, const SampleLines& of,
                const Eigen::MatrixXcd& F, const Eigen::MatrixXd& harmonics, LineSums& sums) {
  const Eigen::Index parts = F.cols() / static_cast<Eigen::Index>(of.size());
  const Eigen::MatrixXd squares = squares_in_directions(F, parts, harmonics);
  for (size_t i = 0; i < of.size(); ++i) {
    const Eigen::Index k = of.lines[i], column = static_cast<Eigen::Index>(i);
    const double weight = velocity.power_factor[k] * of.weight[i];
    const auto f = F.middleCols(column * parts, parts);
    const Eigen::MatrixXd re = f.real(), im = f.imag();
    sums.exchange[k] += weight * to_power * (re.transpose() * re + im.transpose() * im);
    sums.power[k] += weight * to_power * f.rowwise().sum().squaredNorm();
    sums.mean_square.row(k) += weight * squares.col(column).transpose();
  }
}

}  // namespace

LineSums& LineSums::operator+=(const LineSums& other) {
  power += other.power;
  for (size_t k = 0; k < exchange.size(); ++k) exchange[k] += other.exchange[k];
  mean_square += other.mean_square;
  return *this;
}

LineSums& LineSums::operator/=(double count) {
  power /= count;
  for (Eigen::MatrixXd& line : exchange) line /= count;
  mean_square /= count;
  return *this;
}

PanelParts panel_parts(const SoundTable& table, const IndexMatrix& triangles,
                       const rom::SkinRows& T, const std::vector<Panel>& panels) {
  const Eigen::Index n_f = triangles.rows();
  std::vector<std::vector<char>> member(static_cast<size_t>(n_f),
                                        std::vector<char>(panels.size(), 0));
  for (size_t p = 0; p < panels.size(); ++p)
    for (int32_t face : panels[p].faces) member[face][p] = 1;
  std::map<std::vector<char>, int32_t> number;
  std::vector<int32_t> part_of_face(static_cast<size_t>(n_f), -1);
  for (int32_t face : table.flow.face) {
    if (face >= n_f)
      throw InputError(
          fmt::format("sound: flow/face: found face {}, expected 0 to {}, those of "
                      "the reduced model",
                      face, n_f - 1));
    part_of_face[face] =
        number.try_emplace(member[face], static_cast<int32_t>(number.size())).first->second;
  }
  PanelParts out;
  for (const Panel& panel : panels) out.panels.push_back(panel.name);
  out.belongs.resize(static_cast<Eigen::Index>(number.size()),
                     static_cast<Eigen::Index>(panels.size()));
  for (const auto& [members, part] : number)
    for (size_t p = 0; p < panels.size(); ++p)
      out.belongs(part, static_cast<Eigen::Index>(p)) = members[p];
  out.flows = group_flows(table.flow, triangles, T, part_of_face, static_cast<int>(number.size()),
                          table.samples.front().far.cols());
  return out;
}

Eigen::Index lines_of_table(const SoundTable& table, const LineSpectrum& velocity) {
  Eigen::Index count = 0;
  while (count < velocity.frequency_hz.size() && covers(table, velocity.frequency_hz[count]))
    ++count;
  return count;
}

ThirdOctaves bands_of_table(const SoundTable& table, const Analysis& analysis,
                            const Options& options) {
  const LineSpectrum& velocity = analysis.velocity;
  const Eigen::VectorXd covered = velocity.frequency_hz.head(lines_of_table(table, velocity));
  const double to_hz = std::min(table.to_hz(), velocity.frequency_hz.maxCoeff());
  return third_octaves(options.spectrum.from_hz, covered_to_hz(covered, to_hz, velocity.periodic),
                       velocity.spacing_hz());
}

LineSums line_sums(const SoundTable& table, const LineSpectrum& velocity, const PanelParts& parts,
                   const Eigen::MatrixXd& harmonics) {
  const Eigen::Index lines = lines_of_table(table, velocity), n = parts.belongs.rows();
  LineSums out{Eigen::VectorXd::Zero(lines),
               std::vector<Eigen::MatrixXd>(lines, Eigen::MatrixXd::Zero(n, n)),
               Eigen::MatrixXd::Zero(lines, harmonics.rows())};
  const double to_power = sound::power_of_far_field(table.space());
  for (Eigen::Index first = 0; first < lines; first += kLinesAtOnce) {
    const Eigen::Index count = std::min(kLinesAtOnce, lines - first);
    const Eigen::MatrixXcd flow = part_flows(velocity, first, count, parts.flows);
    const std::vector<SampleLines> of = lines_of_samples(table, velocity, first, count);
    for (size_t i = 0; i < of.size(); ++i) {
      if (of[i].size() == 0) continue;
      Eigen::MatrixXcd q(flow.rows(), static_cast<Eigen::Index>(of[i].size()) * n);
      for (size_t k = 0; k < of[i].size(); ++k)
        q.middleCols(static_cast<Eigen::Index>(k) * n, n) =
            flow.middleCols((of[i].lines[k] - first) * n, n);
      add_sample(to_power, velocity, of[i],
                 sound::rows_product(table.samples[i].far.transpose(), q), harmonics, out);
    }
  }
  return out;
}

}  // namespace clatter::recover
