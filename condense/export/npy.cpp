// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/npy.hpp"

#include <fmt/format.h>

#include <bit>

#include "core/base/matrix.hpp"

namespace clatter::condense {

static_assert(std::endian::native == std::endian::little);

void NpyWriter::head(const std::string& type, const std::vector<int64_t>& shape) {
  std::string extents;
  for (const int64_t extent : shape) extents += fmt::format("{},", extent);
  std::string text =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, extents);
  constexpr size_t kBefore = 10, kAlignment = 64;  // magic, version, length of the text
  text.append(kAlignment - 1 - (kBefore + text.size()) % kAlignment, ' ');
  text += '\n';
  const auto length = static_cast<uint16_t>(text.size());
  out_ << "\x93NUMPY" << '\x01' << '\0';
  raw(&length, sizeof length);
  out_ << text;
}

void NpyWriter::raw(const void* data, size_t size) {
  out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

void NpyWriter::put(double value) {
  head("<f8", {});
  raw(&value, sizeof value);
}

void NpyWriter::put(const Eigen::VectorXd& values) {
  head("<f8", {values.size()});
  raw(values.data(), static_cast<size_t>(values.size()) * sizeof(double));
}

void NpyWriter::put(const Eigen::MatrixXd& values) {
  const RowMatrix rows = values;
  head("<f8", {rows.rows(), rows.cols()});
  raw(rows.data(), static_cast<size_t>(rows.size()) * sizeof(double));
}

void NpyWriter::put(const std::vector<int64_t>& values, const std::vector<int64_t>& shape) {
  head("<i8", shape);
  raw(values.data(), values.size() * sizeof(int64_t));
}

void NpyWriter::put(const std::string& ascii) {
  head(fmt::format("<U{}", ascii.size()), {});
  for (const char c : ascii) {
    const auto code = static_cast<char32_t>(c);
    raw(&code, sizeof code);
  }
}

void NpyWriter::put_no_text() { head("<U1", {0}); }

}  // namespace clatter::condense
