// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rom/skin_rows.hpp"

#include <fmt/format.h>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::rom {
namespace {

const char* const kRows = "skin/T";

/// Nodes between two wanted ones that are read along with them: a chunk of the file is read as a
/// whole anyway.
constexpr int32_t kNodesReadAlong = 2;

}  // namespace

SkinRows::SkinRows(const std::filesystem::path& rom, int64_t keep)
    : file_(open_artefact(rom, kRomSchema)) {
  const std::vector<int64_t> shape = file_->shape(kRows);
  if (shape.size() != 2)
    throw InputError(
        fmt::format("{}: {}: found {} dimensions, expected 2", rom.string(), kRows, shape.size()));
  rows_ = shape[0];
  columns_ = shape[1];
  if (static_cast<int64_t>(sizeof(double)) * rows_ * columns_ > keep) return;
  read(0, rows_, stored_);
  kept_ = &stored_;
}

Eigen::Map<const RowMatrix> SkinRows::read(Eigen::Index first, Eigen::Index count,
                                           RowMatrix& buffer) const {
  if (kept_ != nullptr) return {kept_->data() + first * columns_, count, columns_};
  file_->read_rows(kRows, first, count, buffer);
  if (!buffer.allFinite())
    throw InputError(fmt::format("{}: {}: rows {} to {}: found a value that is not finite",
                                 file_->path().string(), kRows, first, first + count));
  return {buffer.data(), count, columns_};
}

RowMatrix SkinRows::of_nodes(const std::vector<int32_t>& nodes) const {
  RowMatrix out(3 * static_cast<Eigen::Index>(nodes.size()), columns_), buffer;
  for (size_t begin = 0, end = 0; begin < nodes.size(); begin = end) {
    while (++end < nodes.size() && nodes[end] - nodes[end - 1] <= 1 + kNodesReadAlong) continue;
    const Eigen::Index first = 3 * static_cast<Eigen::Index>(nodes[begin]);
    const auto run = read(first, 3 * static_cast<Eigen::Index>(nodes[end - 1] + 1) - first, buffer);
    for (size_t k = begin; k < end; ++k)
      out.middleRows(3 * static_cast<Eigen::Index>(k), 3) =
          run.middleRows(3 * static_cast<Eigen::Index>(nodes[k]) - first, 3);
  }
  return out;
}

}  // namespace clatter::rom
