// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/line_far_fields.hpp"

#include <fmt/format.h>

#include <map>

#include "core/base/error.hpp"
#include "core/sound/complex_lu.hpp"

namespace clatter::recover {
namespace {

/// Per part: flows of the lines, n_v x n_l.
std::vector<Eigen::MatrixXcd> line_flows(const LineSpectrum& velocity, Eigen::Index lines,
                                         const std::vector<RowMatrix>& flows) {
  Eigen::MatrixXd parts(velocity.amplitude.cols(), 2 * lines);
  parts << velocity.amplitude.topRows(lines).real().transpose(),
      velocity.amplitude.topRows(lines).imag().transpose();
  std::vector<Eigen::MatrixXcd> out;
  for (const RowMatrix& flow : flows) {
    const Eigen::MatrixXd product = flow * parts;
    Eigen::MatrixXcd lines_of_part(flow.rows(), lines);
    lines_of_part.real() = product.leftCols(lines);
    lines_of_part.imag() = product.rightCols(lines);
    out.push_back(std::move(lines_of_part));
  }
  return out;
}

}  // namespace

PanelParts panel_parts(const SoundTable& table, const rom::Skin& skin,
                       const std::vector<Panel>& panels) {
  const Eigen::Index n_f = skin.triangles.rows();
  std::vector<std::vector<char>> member(static_cast<size_t>(n_f),
                                        std::vector<char>(panels.size(), 0));
  for (size_t p = 0; p < panels.size(); ++p)
    for (int32_t face : panels[p].faces) member[static_cast<size_t>(face)][p] = 1;
  std::map<std::vector<char>, int32_t> number;
  std::vector<int32_t> part_of_face(static_cast<size_t>(n_f), -1);
  for (int32_t face : table.flow.face) {
    if (face >= n_f)
      throw InputError(
          fmt::format("sound: flow/face: found face {}, expected 0 to {}, those of "
                      "the reduced model",
                      face, n_f - 1));
    part_of_face[static_cast<size_t>(face)] =
        number.try_emplace(member[static_cast<size_t>(face)], static_cast<int32_t>(number.size()))
            .first->second;
  }
  PanelParts out;
  for (const Panel& panel : panels) out.panels.push_back(panel.name);
  out.belongs.resize(static_cast<Eigen::Index>(number.size()),
                     static_cast<Eigen::Index>(panels.size()));
  for (const auto& [members, part] : number)
    for (size_t p = 0; p < panels.size(); ++p)
      out.belongs(part, static_cast<Eigen::Index>(p)) = members[p];
  out.flows = group_flows(table.flow, skin, part_of_face, static_cast<int>(number.size()),
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
  return third_octaves(options.spectrum.from_hz,
                       std::min(table.to_hz(), velocity.frequency_hz.maxCoeff()),
                       velocity.spacing_hz());
}

std::vector<SampleFields> line_far_fields(const SoundTable& table, const LineSpectrum& velocity,
                                          const std::vector<RowMatrix>& flows) {
  const Eigen::Index lines = lines_of_table(table, velocity);
  const auto parts = static_cast<Eigen::Index>(flows.size());
  std::vector<SampleFields> out(table.samples.size());
  for (Eigen::Index k = 0; k < lines; ++k) {
    if (!(velocity.frequency_hz[k] > 0.0)) continue;  // a motion at 0 Hz radiates nothing
    const Stencil by = power_stencil(table, velocity.frequency_hz[k]);
    for (Eigen::Index i = 0; i < by.weight.size(); ++i) {
      SampleFields& fields = out[by.first + static_cast<size_t>(i)];
      fields.lines.push_back(k);
      fields.weight.push_back(by.weight[i]);
    }
  }
  const std::vector<Eigen::MatrixXcd> flow = line_flows(velocity, lines, flows);
  for (size_t i = 0; i < out.size(); ++i) {
    const Eigen::MatrixXcd& far = table.samples[i].far;
    const auto count = static_cast<Eigen::Index>(out[i].lines.size());
    Eigen::MatrixXcd q(far.cols(), count * parts);
    for (Eigen::Index k = 0; k < count; ++k)
      for (Eigen::Index p = 0; p < parts; ++p)
        q.col(k * parts + p) =
            flow[static_cast<size_t>(p)].col(out[i].lines[static_cast<size_t>(k)]);
    if (q.cols() > 0) out[i].F = sound::rows_product(far.transpose(), q);
  }
  return out;
}

}  // namespace clatter::recover
