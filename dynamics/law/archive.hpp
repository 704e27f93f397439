// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Numbers of a checkpoint, which are saved and restored by the same calls.
#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/error.hpp"

namespace clatter::dynamics {

/// A class passes its members to an archive in one function, `archive(Archive&)`: one that saves
/// takes their numbers, one that restores sets them, and sizes, in the same order.
class Archive {
 public:
  /// Saves.
  Archive() = default;
  /// Restores what numbers() of another one were. InputError where they are too few.
  explicit Archive(std::vector<double> numbers) : numbers_(std::move(numbers)), restores_(true) {}

  template <class T>
  requires std::integral<T> || std::floating_point<T>
  void operator()(T& value) {
    if (restores_)
      value = static_cast<T>(next());
    else
      numbers_.push_back(static_cast<double>(value));
  }
  void operator()(Eigen::VectorXd& values) {
    Eigen::Index size = values.size();
    (*this)(size);
    if (restores_) values.resize(fitting(size));
    for (double& value : values) (*this)(value);
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    std::ptrdiff_t size = std::ssize(values);
    (*this)(size);
    if (restores_) values.resize(static_cast<size_t>(fitting(size)));
    for (T& value : values) (*this)(value);
  }
  /// The first rows of a matrix that has them.
  template <class Matrix>
  void rows(Matrix& values, Eigen::Index count) {
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index j = 0; j < values.cols(); ++j) (*this)(values(i, j));
  }

  /// Where it restores, whether all numbers were used.
  bool is_used_up() const { return at_ == numbers_.size(); }
  /// What was saved.
  std::vector<double> numbers() && { return std::move(numbers_); }

 private:
  double next() {
    if (is_used_up()) throw InputError("run: found too few numbers");
    return numbers_[at_++];
  }
  /// A size that the numbers left can have.
  std::ptrdiff_t fitting(std::ptrdiff_t size) const {
    if (size < 0 || size > std::ssize(numbers_) - static_cast<std::ptrdiff_t>(at_))
      throw InputError("run: found too few numbers");
    return size;
  }

  std::vector<double> numbers_;
  size_t at_ = 0;
  bool restores_ = false;
};

}  // namespace clatter::dynamics
