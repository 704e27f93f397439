// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/film_stream.hpp"

#include <numbers>

#include "core/run/run_layout.hpp"

namespace clatter::dynamics {
namespace {

constexpr int64_t kBlock = 32768;  // numbers of a field in memory: 128 KiB

}  // namespace

void FilmStream::add() {
  const bool first = fields_.empty();
  for (const film::PadSnapshot& pad : contact_->snapshot()) {
    const std::string group = run::path(group_, pad.name);
    if (first) {
      file_->write(run::path(group, "angle_deg"),
                   Eigen::VectorXd(pad.angle * (180.0 / std::numbers::pi)));
      file_->write(run::path(group, "axial"), pad.axial);
    }
    put(run::path(group, "gap"), pad.gap);
    put(run::path(group, "pressure"), pad.pressure);
    put(run::path(group, "fill"), pad.fill);
    put(run::path(group, "contact_pressure"), pad.contact_pressure);
  }
}

void FilmStream::put(const std::string& name, const RowMatrix& frame) {
  if (frame.size() == 0) return;
  Field& field = fields_[name];
  field.around = frame.rows();
  field.along = frame.cols();
  for (Eigen::Index k = 0; k < frame.size(); ++k)
    field.values.push_back(static_cast<float>(frame.data()[k]));
  if (std::ssize(field.values) + field.cells() > kBlock) flush(name, field);
}

void FilmStream::flush(const std::string& name, Field& field) {
  const int64_t frames = std::ssize(field.values) / field.cells();
  if (frames > 0) file_->append_float(name, field.values, {frames, field.around, field.along});
  field.values.clear();
}

void FilmStream::finish() {
  for (auto& [name, field] : fields_) flush(name, field);
}

int64_t FilmStream::held() const {
  int64_t sum = 0;
  for (const auto& entry : fields_) sum += std::ssize(entry.second.values);
  return sum;
}

}  // namespace clatter::dynamics
