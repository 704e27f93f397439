// SPDX-License-Identifier: GPL-3.0-or-later
// The part of the field file with data of the entire skin: frames in time and complex lines.
#include <cstdint>
#include <string>

#include "core/base/progress.hpp"
#include "recover/field/expand.hpp"
#include "recover/field/field_file.hpp"

namespace clatter::recover {
namespace {

std::vector<float> to_float(const Eigen::Ref<const Eigen::VectorXd>& values) {
  const Eigen::VectorXf single = values.cast<float>();
  return {single.begin(), single.end()};
}

/// Reduced coordinates of the chosen samples, one column per frame.
Eigen::MatrixXd frame_columns(const RunBody& body, const std::string& quantity, const Piece& piece,
                              const std::vector<int64_t>& samples) {
  const RowMatrix rows = body.samples(quantity, piece.first, piece.count);
  Eigen::MatrixXd columns(rows.cols(), static_cast<Eigen::Index>(samples.size()));
  for (size_t k = 0; k < samples.size(); ++k)
    columns.col(static_cast<Eigen::Index>(k)) = rows.row(samples[k] - piece.first);
  return columns;
}

/// Writes one vector field per frame, and its face normal component when an operator is given.
void write_vector_frames(H5File& file, const std::string& group, const rom::Skin& skin,
                         const Eigen::MatrixXd& reduced, const SparseRows* face_normal) {
  const int64_t n_s = skin.nodes.rows();
  Progress progress("frames: " + group, static_cast<double>(reduced.cols()), "frames");
  expand(skin.T, reduced, expansion_block(skin.T.rows()),
         [&](int64_t first, const Eigen::MatrixXd& u) {
           for (int64_t k = 0; k < u.cols(); ++k) {
             const std::string member = member_name(static_cast<size_t>(first + k));
             file.write_float("frames/" + group + "/" + member, to_float(u.col(k)), {n_s, 3});
             if (face_normal != nullptr)
               file.write_float("frames/normal_velocity/" + member,
                                to_float(*face_normal * u.col(k)), {face_normal->rows()});
           }
           progress.update(static_cast<double>(first + u.cols()));
         });
}

void describe(H5File& file, const std::string& group, const std::string& unit,
              const std::string& meaning) {
  file.set(group, "unit", unit);
  file.set(group, "meaning", meaning);
}

/// One part of a complex line: the vector field and its face normal component.
void write_line_part(H5File& file, const std::string& part, const std::string& member,
                     const Eigen::VectorXd& u, const SparseRows& face_normal) {
  file.write("lines/velocity_" + part + "/" + member,
             RowMatrix(Eigen::Map<const RowMatrix>(u.data(), u.size() / 3, 3)));
  file.write("lines/normal_velocity_" + part + "/" + member, Eigen::VectorXd(face_normal * u));
}

}  // namespace

FrameIndex write_frames(H5File& file, const RunBody& body, const rom::Skin& skin,
                        const SparseRows& face_normal, const Piece& piece,
                        const std::vector<int64_t>& samples, bool displacement) {
  FrameIndex index{.displacement = displacement};
  const RunClock& clock = body.clock();
  for (int64_t sample : samples) {
    index.time_s.push_back(clock.time[sample] - piece.ftdc_s);
    if (clock.has_crank()) index.angle_deg.push_back(clock.angle_deg[sample] - piece.ftdc_deg);
  }
  file.write("frames/time", index.time_s);
  describe(file, "frames/time", "s", "instant of each frame, from firing TDC");
  if (clock.has_crank()) {
    file.write("frames/crank_angle_deg", index.angle_deg);
    describe(file, "frames/crank_angle_deg", "deg", "crank angle of each frame, from firing TDC");
  }
  if (displacement) {
    write_vector_frames(file, "displacement", skin, frame_columns(body, "q", piece, samples),
                        nullptr);
    describe(file, "frames/displacement", "m", "one dataset a frame: nodes x 3");
  }
  write_vector_frames(file, "velocity", skin, frame_columns(body, "v", piece, samples),
                      &face_normal);
  describe(file, "frames/velocity", "m/s", "one dataset a frame: nodes x 3");
  describe(file, "frames/normal_velocity", "m/s",
           "one dataset a frame: mean outward normal velocity of each triangle");
  return index;
}

void write_lines(H5File& file, const Analysis& analysis, const std::vector<ChosenLine>& lines,
                 const rom::Skin& skin, const SparseRows& face_normal) {
  const LineSpectrum& spectrum = analysis.velocity;
  const auto n_l = static_cast<Eigen::Index>(lines.size());
  std::vector<double> frequency_hz, requested_hz;
  // Real and imaginary parts are adjacent columns of one expansion.
  Eigen::MatrixXd reduced(spectrum.amplitude.cols(), 2 * n_l);
  for (Eigen::Index k = 0; k < n_l; ++k) {
    const ChosenLine& line = lines[static_cast<size_t>(k)];
    frequency_hz.push_back(spectrum.frequency_hz[line.index]);
    requested_hz.push_back(line.requested_hz);
    reduced.col(2 * k) = spectrum.amplitude.row(line.index).real();
    reduced.col(2 * k + 1) = spectrum.amplitude.row(line.index).imag();
  }
  file.write("lines/frequency_hz", frequency_hz);
  describe(file, "lines/frequency_hz", "Hz", "frequency of each line");
  file.write("lines/requested_hz", requested_hz);
  describe(file, "lines/requested_hz", "Hz", "what was asked for; the nearest line was taken");
  file.set("lines", "analysis", analysis.piece.name);
  file.set("lines", "amplitude", "peak");
  file.set("lines", "phase", file.get_string("/", "phase"));

  expand(skin.T, reduced, expansion_block(skin.T.rows()),
         [&](int64_t first, const Eigen::MatrixXd& u) {
           for (int64_t c = 0; c < u.cols(); ++c)
             write_line_part(file, (first + c) % 2 == 0 ? "re" : "im",
                             member_name(static_cast<size_t>((first + c) / 2)), u.col(c),
                             face_normal);
         });
  if (n_l == 0) return;
  for (const char* part : {"re", "im"}) {
    describe(file, std::string("lines/velocity_") + part, "m/s",
             "one dataset a line: nodes x 3, peak");
    describe(file, std::string("lines/normal_velocity_") + part, "m/s",
             "one dataset a line: mean outward normal velocity of each triangle, peak");
  }
}

}  // namespace clatter::recover
