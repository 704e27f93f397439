// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/field_stream.hpp"

#include <functional>
#include <numeric>

namespace clatter::dynamics {
namespace {

constexpr int64_t kBlock = 32768;  // numbers of a field in memory: 128 KiB

}  // namespace

void FieldStream::add(const std::string& name, const RowMatrix& frame) {
  add(name, frame.data(), {frame.rows(), frame.cols()});
}

void FieldStream::add(const std::string& name, const Eigen::VectorXd& frame) {
  add(name, frame.data(), {frame.size()});
}

void FieldStream::add(const std::string& name, const double* values,
                      const std::vector<int64_t>& shape) {
  const int64_t cells =
      std::accumulate(shape.begin(), shape.end(), int64_t{1}, std::multiplies<>());
  if (cells == 0) return;
  Field& field = fields_[name];
  field.shape = shape;
  field.cells = cells;
  for (int64_t k = 0; k < cells; ++k) field.values.push_back(static_cast<float>(values[k]));
  if (std::ssize(field.values) + cells > kBlock) flush(name, field);
}

void FieldStream::flush(const std::string& name, Field& field) {
  std::vector<int64_t> shape{std::ssize(field.values) / field.cells};
  shape.insert(shape.end(), field.shape.begin(), field.shape.end());
  if (shape.front() > 0) file_->append_float(name, field.values, shape);
  field.values.clear();
}

void FieldStream::finish() {
  for (auto& [name, field] : fields_) flush(name, field);
}

int64_t FieldStream::held() const {
  int64_t sum = 0;
  for (const auto& entry : fields_) sum += std::ssize(entry.second.values);
  return sum;
}

}  // namespace clatter::dynamics
