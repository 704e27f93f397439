// SPDX-License-Identifier: GPL-3.0-or-later
// The part of the field file with data of the entire skin: frames in time and complex lines.
#include <algorithm>
#include <complex>
#include <cstdint>
#include <numbers>
#include <string>

#include "core/base/progress.hpp"
#include "recover/field/field_file.hpp"

namespace clatter::recover {
namespace {

/// A quantity of the nodes and its name in the run.
struct NodeQuantity {
  const char* name;
  const char* unit;
  const char* of_run;
  bool Quantities::*chosen;
};

constexpr NodeQuantity kNodeQuantities[] = {
    {"displacement", "m", "q", &Quantities::displacement},
    {"velocity", "m/s", "v", &Quantities::velocity},
    {"acceleration", "m/s2", "a", &Quantities::acceleration}};

constexpr const char* kVelocity = kNodeQuantities[1].name;

/// What is expanded: the chosen quantities, and the velocity for the normal velocity.
std::vector<NodeQuantity> expanded(const Quantities& quantities) {
  std::vector<NodeQuantity> list;
  for (const NodeQuantity& quantity : kNodeQuantities)
    if (quantities.*quantity.chosen || (quantity.name == kVelocity && quantities.normal_velocity))
      list.push_back(quantity);
  return list;
}

/// Datasets of member `member` of a quantity in `group`; `part` is empty, "_re" or "_im".
SkinDatasets datasets(const std::string& group, const NodeQuantity& quantity,
                      const Quantities& quantities, const std::string& part,
                      const std::string& member) {
  SkinDatasets out;
  if (quantities.*quantity.chosen) out.vectors = group + "/" + quantity.name + part + "/" + member;
  if (quantity.name == kVelocity && quantities.normal_velocity)
    out.normals = group + "/normal_velocity" + part + "/" + member;
  return out;
}

/// Reduced coordinates of the samples [begin, end) of the list, one column per frame.
Eigen::MatrixXd frame_columns(const RunBody& body, const std::string& quantity,
                              const std::vector<int64_t>& samples, size_t begin, size_t end) {
  const int64_t first = samples[begin];
  const RowMatrix rows = body.samples(quantity, first, samples[end - 1] - first + 1);
  Eigen::MatrixXd columns(rows.cols(), static_cast<Eigen::Index>(end - begin));
  for (size_t k = begin; k < end; ++k)
    columns.col(static_cast<Eigen::Index>(k - begin)) = rows.row(samples[k] - first);
  return columns;
}

void describe(H5File& file, const std::string& group, const std::string& unit,
              const std::string& meaning) {
  file.set(group, "unit", unit);
  file.set(group, "meaning", meaning);
}

void describe_quantities(H5File& file, const std::string& group, const Quantities& quantities,
                         const std::string& part, const std::string& member) {
  for (const NodeQuantity& quantity : kNodeQuantities)
    if (quantities.*quantity.chosen)
      describe(file, group + "/" + quantity.name + part, quantity.unit,
               "one dataset a " + member + ": nodes x 3" + (part.empty() ? "" : ", peak"));
  if (quantities.normal_velocity)
    describe(file, group + "/normal_velocity" + part, "m/s",
             "one dataset a " + member + ": mean outward normal velocity of each triangle" +
                 (part.empty() ? "" : ", peak"));
}

void write_frame_axes(H5File& file, const FrameIndex& index) {
  file.write("frames/time", index.time_s);
  describe(file, "frames/time", "s", "instant of each frame, from crank angle 0");
  if (index.angle_deg.empty()) return;
  file.write("frames/crank_angle_deg", index.angle_deg);
  describe(file, "frames/crank_angle_deg", "deg", "crank angle of each frame");
}

/// Factor that takes a line of velocity to the quantity.
std::complex<double> from_velocity(const NodeQuantity& quantity, double frequency_hz) {
  const std::complex<double> i_w(0.0, 2.0 * std::numbers::pi * frequency_hz);
  if (quantity.name == kVelocity) return 1.0;
  return quantity.of_run[0] == 'q' ? 1.0 / i_w : i_w;
}

}  // namespace

FrameIndex write_frames(H5File& file, const RunBody& body, const SkinWriter& writer,
                        const Piece& piece, const std::vector<int64_t>& samples,
                        const Quantities& quantities) {
  FrameIndex index{.quantities = quantities};
  const RunClock& clock = body.clock();
  for (int64_t sample : samples) {
    index.time_s.push_back(clock.time[sample] - piece.ftdc_s);
    if (clock.has_crank()) index.angle_deg.push_back(clock.angle_deg[sample] - piece.ftdc_deg);
  }
  write_frame_axes(file, index);
  const std::vector<NodeQuantity> list = expanded(quantities);
  const size_t at_once = std::max<size_t>(
      static_cast<size_t>(writer.columns_at_once(quantities.normal_velocity)) / list.size(), 1);
  Progress progress("frames", static_cast<double>(samples.size() * list.size()), "fields");
  double done = 0.0;
  for (size_t begin = 0; begin < samples.size(); begin += at_once) {
    const size_t end = std::min(begin + at_once, samples.size());
    const auto frames = static_cast<Eigen::Index>(end - begin);
    Eigen::MatrixXd reduced;
    std::vector<SkinDatasets> columns;
    for (size_t i = 0; i < list.size(); ++i) {
      const Eigen::MatrixXd part = frame_columns(body, list[i].of_run, samples, begin, end);
      reduced.conservativeResize(part.rows(), reduced.cols() + frames);
      reduced.rightCols(frames) = part;
      for (size_t k = begin; k < end; ++k)
        columns.push_back(datasets("frames", list[i], quantities, "", member_name(k)));
    }
    writer.write(file, reduced, columns, true,
                 [&](double written) { progress.update(done += written); });
  }
  describe_quantities(file, "frames", quantities, "", "frame");
  return index;
}

LineIndex write_lines(H5File& file, const Analysis& analysis, const std::vector<ChosenLine>& lines,
                      const SkinWriter& writer, const Quantities& quantities, bool single) {
  const LineSpectrum& spectrum = analysis.velocity;
  const std::vector<NodeQuantity> list = expanded(quantities);
  LineIndex index{.quantities = quantities, .single = single};
  std::vector<double> requested_hz;
  for (const ChosenLine& line : lines) {
    index.frequency_hz.push_back(spectrum.frequency_hz[line.index]);
    requested_hz.push_back(line.requested_hz);
  }
  file.write("lines/frequency_hz", index.frequency_hz);
  describe(file, "lines/frequency_hz", "Hz", "frequency of each line");
  file.write("lines/requested_hz", requested_hz);
  describe(file, "lines/requested_hz", "Hz", "what was asked for; the nearest line was taken");
  file.set("lines", "analysis", analysis.piece.name);
  file.set("lines", "amplitude", "peak");
  file.set("lines", "phase", file.get_string("/", "phase"));

  // Real and imaginary parts are adjacent columns of one expansion.
  const size_t at_once = std::max<size_t>(
      static_cast<size_t>(writer.columns_at_once(quantities.normal_velocity)) / (2 * list.size()),
      1);
  for (size_t begin = 0; begin < lines.size(); begin += at_once) {
    const size_t end = std::min(begin + at_once, lines.size());
    Eigen::MatrixXd reduced(spectrum.amplitude.cols(),
                            static_cast<Eigen::Index>(2 * (end - begin) * list.size()));
    std::vector<SkinDatasets> columns;
    for (size_t k = begin; k < end; ++k)
      for (const NodeQuantity& quantity : list) {
        const auto at = static_cast<Eigen::Index>(columns.size());
        const Eigen::RowVectorXcd line =
            from_velocity(quantity, index.frequency_hz[k]) * spectrum.amplitude.row(lines[k].index);
        reduced.col(at) = line.real();
        reduced.col(at + 1) = line.imag();
        for (const char* part : {"_re", "_im"})
          columns.push_back(datasets("lines", quantity, quantities, part, member_name(k)));
      }
    writer.write(file, reduced, columns, single);
  }
  if (!lines.empty())
    for (const char* part : {"_re", "_im"})
      describe_quantities(file, "lines", quantities, part, "line");
  return index;
}

}  // namespace clatter::recover
