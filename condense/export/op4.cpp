// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/op4.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "condense/export/pencil_modes.hpp"
#include "core/base/whole_file.hpp"

namespace clatter::condense {
namespace {

constexpr int32_t kRectangular = 2, kSymmetric = 6;  // forms
constexpr int32_t kDouble = 2;                       // type

/// One part of a file: its header, then columns, then a column beyond the last with the value 1.
class Op4 {
 public:
  Op4(std::ostream& out, bool binary) : out_(out), binary_(binary) {}

  void put(const std::string& name, const Eigen::MatrixXd& matrix, int32_t form) {
    head(name, matrix, form);
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      Eigen::Index first = 0, end = matrix.rows();
      while (first < end && tiny(matrix(first, j))) ++first;
      while (end > first && tiny(matrix(end - 1, j))) --end;
      if (first < end)
        column(j + 1, first + 1, matrix.col(j).segment(first, end - first), 2 * (end - first));
    }
    column(matrix.cols() + 1, 1, Eigen::VectorXd::Ones(1), binary_ ? 2 : 1);
  }

 private:
  /// An exponent of three digits does not fit into E23.16.
  static bool tiny(double value) { return std::abs(value) < 1e-99; }

  void head(const std::string& name, const Eigen::MatrixXd& matrix, int32_t form) {
    const std::array<int32_t, 4> numbers = {static_cast<int32_t>(matrix.cols()),
                                            static_cast<int32_t>(matrix.rows()), form, kDouble};
    if (!binary_) {
      for (const int32_t number : numbers) out_ << fmt::format("{:8}", number);
      out_ << fmt::format("{:<8}1P,3E23.16\n", name);
      return;
    }
    const std::string padded = fmt::format("{:<8}", name);
    record({{numbers.data(), sizeof numbers}, {padded.data(), padded.size()}});
  }

  /// @param words of four bytes.
  void column(Eigen::Index index, Eigen::Index first, const Eigen::VectorXd& values,
              Eigen::Index words) {
    const std::array<int32_t, 3> numbers = {
        static_cast<int32_t>(index), static_cast<int32_t>(first), static_cast<int32_t>(words)};
    if (binary_)
      return record({{numbers.data(), sizeof numbers},
                     {values.data(), static_cast<size_t>(values.size()) * sizeof(double)}});
    for (const int32_t number : numbers) out_ << fmt::format("{:8}", number);
    for (Eigen::Index i = 0; i < values.size(); ++i)
      out_ << (i % 3 == 0 ? "\n" : "")
           << fmt::format("{:23.16E}", tiny(values[i]) ? 0.0 : values[i]);
    out_ << '\n';
  }

  struct Bytes {
    const void* data;
    size_t size;
  };

  /// A Fortran record: its length before and after it.
  void record(const std::vector<Bytes>& parts) {
    int32_t length = 0;
    for (const Bytes& bytes : parts) length += static_cast<int32_t>(bytes.size);
    raw(&length, sizeof length);
    for (const Bytes& bytes : parts) raw(bytes.data, bytes.size);
    raw(&length, sizeof length);
  }

  void raw(const void* data, size_t size) {
    out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  }

  std::ostream& out_;
  bool binary_;
};

/// Coordinates by node and component.
std::vector<Eigen::Index> internal_sequence(const std::vector<rom::MappedDof>& map) {
  std::vector<Eigen::Index> order(map.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    const rom::MappedDof &x = map[a], &y = map[b];
    return std::pair(x.node, x.component) < std::pair(y.node, y.component);
  });
  return order;
}

}  // namespace

void export_op4(const ExportedPart& part, const std::filesystem::path& path) {
  const std::vector<Eigen::Index> order = internal_sequence(part.map);
  Eigen::MatrixXd dofs(part.model.size(), 2);
  for (size_t i = 0; i < order.size(); ++i) {
    const rom::MappedDof& dof = part.map[order[i]];
    dofs.row(static_cast<Eigen::Index>(i)) << dof.node, dof.component;
  }
  const Eigen::MatrixXd D = damping_of(part.model);
  WholeFile file(path);
  Op4 op4(file.stream(), part.options.binary);
  op4.put("KAA", part.model.K_rr(order, order), kSymmetric);
  op4.put("MAA", part.model.M_rr(order, order), kSymmetric);
  if (!D.isZero(0.0)) op4.put("BAA", D(order, order), kSymmetric);
  op4.put("DOFS", dofs, kRectangular);
  file.commit();
}

}  // namespace clatter::condense
