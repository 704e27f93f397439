// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/field/skin_writer.hpp"

#include <algorithm>

#include "core/base/threads.hpp"

namespace clatter::recover {
namespace {

/// Writes rows [row, row + values.size()) of a column, three to a node.
void write_nodes(H5File& file, const std::string& name, int64_t row,
                 const Eigen::Ref<const Eigen::VectorXd>& values, bool single,
                 Eigen::VectorXf& buffer) {
  if (!single) return file.write_part(name, row / 3, values.data(), values.size());
  buffer = values.cast<float>();
  file.write_part(name, row / 3, buffer.data(), buffer.size());
}

/// Positions in `columns` of those with normal components; -1 for the others.
std::vector<Eigen::Index> number_normals(const std::vector<SkinDatasets>& columns) {
  std::vector<Eigen::Index> numbers;
  Eigen::Index count = 0;
  for (const SkinDatasets& column : columns)
    numbers.push_back(column.normals.empty() ? -1 : count++);
  return numbers;
}

}  // namespace

SkinWriter::SkinWriter(const rom::SkinRows& T, const SparseRows& face_normal)
    : T_(T), face_normal_(face_normal) {}

int64_t SkinWriter::columns_at_once(bool with_normals) const {
  constexpr int64_t kDoubles = int64_t{32} << 20;
  const int64_t rows = std::max<int64_t>(T_.cols(), with_normals ? face_normal_.rows() : 1);
  return std::max<int64_t>(kDoubles / std::max<int64_t>(rows, 1), 1);
}

void SkinWriter::write(H5File& file, const Eigen::MatrixXd& reduced,
                       const std::vector<SkinDatasets>& columns, bool single,
                       const Report& report) const {
  const std::vector<int64_t> shape{T_.rows() / 3, 3};
  for (const SkinDatasets& column : columns)
    if (!column.vectors.empty()) file.create(column.vectors, shape, single);
  const std::vector<Eigen::Index> numbers = number_normals(columns);
  const Eigen::Index n_normals =
      numbers.empty() ? 0 : 1 + *std::max_element(numbers.begin(), numbers.end());
  Eigen::MatrixXd normals = Eigen::MatrixXd::Zero(face_normal_.rows(), n_normals);
  Eigen::VectorXf buffer;
  const ExpansionBlock block = expansion_block(T_, 3 * H5File::rows_of_a_chunk(shape, true));
  const double share = 1.0 / static_cast<double>(T_.rows());

  expand(T_, reduced, block, [&](int64_t row, int64_t first, const Eigen::MatrixXd& u) {
    parallel_pieces(u.cols(), [&](int64_t begin, int64_t end) {
      for (int64_t c = begin; c < end; ++c)
        if (const Eigen::Index number = numbers[first + c]; number >= 0)
          normals.col(number).noalias() += face_normal_.middleCols(row, u.rows()) * u.col(c);
    });
    for (int64_t c = 0; c < u.cols(); ++c)
      if (const std::string& name = columns[first + c].vectors; !name.empty())
        write_nodes(file, name, row, u.col(c), single, buffer);
    file.begin_disk_writes();
    if (report) report(static_cast<double>(u.size()) * share);
  });

  for (size_t c = 0; c < columns.size(); ++c) {
    if (numbers[c] < 0) continue;
    file.create(columns[c].normals, {face_normal_.rows()}, single);
    if (single) {
      buffer = normals.col(numbers[c]).cast<float>();
      file.write_part(columns[c].normals, 0, buffer.data(), buffer.size());
    } else {
      file.write_part(columns[c].normals, 0, normals.col(numbers[c]).data(), normals.rows());
    }
  }
}

}  // namespace clatter::recover
