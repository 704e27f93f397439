// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/matrix_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <tuple>

#include "core/base/error.hpp"
#include "core/base/text_lines.hpp"
#include "core/base/whole_file.hpp"

namespace clatter {
namespace {

/// An entry mapped to the lower triangle, with its original position.
struct Entry {
  int32_t row, column;
  bool above;  // it was above the diagonal
  double value;
  int64_t line;
};

struct Head {
  bool array = false, symmetric = false;
  int64_t size = 0, entries = 0;
};

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

bool next_data(TextLines& lines, std::vector<std::string_view>& words) {
  std::string_view line;
  while (lines.next(line)) {
    if (line.starts_with('%')) continue;
    words = words_of(line);
    if (!words.empty()) return true;
  }
  return false;
}

int32_t index_of(const TextLines& lines, std::string_view word, int64_t size) {
  const int64_t index = lines.integer(word);
  if (index < 1 || index > size)
    lines.refuse(fmt::format("index {}", index), fmt::format("1 to {}", size));
  return static_cast<int32_t>(index - 1);
}

Entry make_entry(int32_t row, int32_t column, double value, int64_t line) {
  return {std::max(row, column), std::min(row, column), row < column, value, line};
}

Head read_head(TextLines& lines, const std::string& banner) {
  const auto words = words_of(banner);
  Head head;
  const bool known = words.size() == 5 && words[1] == "matrix" &&
                     (words[2] == "coordinate" || words[2] == "array") &&
                     (words[3] == "real" || words[3] == "integer") &&
                     (words[4] == "symmetric" || words[4] == "general");
  if (!known)
    lines.refuse(fmt::format("\"{:.80}\"", banner),
                 "%%MatrixMarket matrix, coordinate or array, real or integer, symmetric or "
                 "general");
  head.array = words[2] == "array";
  head.symmetric = words[4] == "symmetric";
  std::vector<std::string_view> sizes;
  const size_t expected = head.array ? 2 : 3;
  if (!next_data(lines, sizes) || sizes.size() != expected)
    lines.refuse(fmt::format("{} numbers", sizes.size()),
                 head.array ? "rows and columns" : "rows, columns and entries");
  head.size = lines.integer(sizes[0]);
  if (head.size < 1 || head.size > INT32_MAX || lines.integer(sizes[1]) != head.size)
    lines.refuse(fmt::format("{} x {}", sizes[0], sizes[1]), "a square matrix");
  if (!head.array) head.entries = lines.integer(sizes[2]);
  return head;
}

std::vector<Entry> read_array(TextLines& lines, const Head& head) {
  std::vector<Entry> entries;
  std::vector<std::string_view> words;
  for (int32_t j = 0; j < head.size; ++j) {
    for (int32_t i = head.symmetric ? j : 0; i < head.size; ++i) {
      if (!next_data(lines, words) || words.size() != 1)
        lines.refuse(fmt::format("{} numbers", words.size()),
                     fmt::format("the entry of row {}, column {}", i + 1, j + 1));
      const double value = lines.real(words[0]);
      if (value != 0.0) entries.push_back(make_entry(i, j, value, lines.number()));
    }
  }
  return entries;
}

std::vector<Entry> read_list(TextLines& lines, const Head& head) {
  std::vector<Entry> entries;
  std::vector<std::string_view> words;
  while (next_data(lines, words)) {
    if (words.size() != 3)
      lines.refuse(fmt::format("{} numbers", words.size()), "row, column and value");
    const int32_t row = index_of(lines, words[0], head.size);
    const int32_t column = index_of(lines, words[1], head.size);
    if (head.symmetric && row < column)
      lines.refuse(fmt::format("row {}, column {}", words[0], words[1]),
                   "the lower triangle of a symmetric matrix");
    entries.push_back(make_entry(row, column, lines.real(words[2]), lines.number()));
  }
  return entries;
}

/// Entries of the same row and column become adjacent, the lower one first.
void sort(std::vector<Entry>& entries) {
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.column, a.row, a.above, a.line) < std::tie(b.column, b.row, b.above, b.line);
  });
}

Eigen::VectorXd diagonal_of(const std::vector<Entry>& entries, int64_t size) {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(size);
  for (const Entry& e : entries)
    if (e.row == e.column) diagonal[e.row] = e.value;
  return diagonal;
}

SparseMatrix assemble(std::vector<Entry> entries, const Head& head, const std::string& file) {
  if (static_cast<int64_t>(entries.size()) < head.size)
    throw InputError(fmt::format("{}: found {} entries, expected one or more in each of {} rows",
                                 file, entries.size(), head.size));
  sort(entries);
  const Eigen::VectorXd diagonal = diagonal_of(entries, head.size);
  SparseMatrix lower(static_cast<int>(head.size), static_cast<int>(head.size));
  std::vector<Eigen::Triplet<double>> triplets;
  for (size_t k = 0; k < entries.size();) {
    const Entry& e = entries[k];
    const auto same = [&](size_t m) {
      return m < entries.size() && entries[m].row == e.row && entries[m].column == e.column;
    };
    const bool pair = same(k + 1) && entries[k + 1].above != e.above;
    const size_t next = k + (pair ? 2 : 1);
    const int32_t row = e.above ? e.column : e.row, column = e.above ? e.row : e.column;
    if (same(next))
      throw InputError(fmt::format("{}:{}: found row {}, column {} a second time, expected it once",
                                   file, entries[next].line,
                                   entries[next].above ? e.column + 1 : e.row + 1,
                                   entries[next].above ? e.row + 1 : e.column + 1));
    const double mirror = pair ? entries[k + 1].value : 0.0;
    const double limit = 1e-9 * std::sqrt(std::abs(diagonal[e.row] * diagonal[e.column]));
    if (!head.symmetric && e.row != e.column && !(std::abs(e.value - mirror) <= limit))
      throw InputError(
          fmt::format("{}:{}: found {:.9g} in row {}, column {} and {:.9g} across the diagonal, "
                      "expected a symmetric matrix",
                      file, e.line, e.value, row + 1, column + 1, mirror));
    triplets.emplace_back(e.row, e.column, e.value);
    k = next;
  }
  lower.setFromTriplets(triplets.begin(), triplets.end());
  return lower;
}

}  // namespace

void write_matrix_market(const std::filesystem::path& path, const Eigen::MatrixXd& symmetric,
                         const std::vector<std::string>& comments) {
  const Eigen::Index n = symmetric.rows();
  Eigen::Index count = 0;
  for (Eigen::Index j = 0; j < n; ++j)
    count += (symmetric.col(j).tail(n - j).array() != 0.0).count();
  WholeFile file(path);
  std::ostream& out = file.stream();
  out << "%%MatrixMarket matrix coordinate real symmetric\n";
  for (const std::string& comment : comments) out << "% " << comment << '\n';
  out << fmt::format("{} {} {}\n", n, n, count);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = j; i < n; ++i)
      if (symmetric(i, j) != 0.0)
        out << fmt::format("{} {} {:.16e}\n", i + 1, j + 1, symmetric(i, j));
  file.commit();
}

SparseMatrix read_matrix_text(const std::filesystem::path& path) {
  std::optional<TextLines> lines(path);
  std::string_view first;
  if (!lines->next(first)) lines->refuse("an empty file", "a matrix");
  const std::string banner = lower_case(first);
  Head head;
  std::vector<Entry> entries;
  if (banner.starts_with("%%matrixmarket")) {
    head = read_head(*lines, banner);
    entries = head.array ? read_array(*lines, head) : read_list(*lines, head);
    if (!head.array && static_cast<int64_t>(entries.size()) != head.entries)
      lines->refuse(fmt::format("{} entries", entries.size()), fmt::format("{}", head.entries));
  } else {
    lines.emplace(path);  // the first line is an entry
    head.size = INT32_MAX;
    entries = read_list(*lines, head);
    head.size = 0;
    for (const Entry& e : entries) head.size = std::max<int64_t>(head.size, e.row + 1);
  }
  if (entries.empty()) lines->refuse("no entry", "a matrix");
  return assemble(std::move(entries), head, path.string());
}

}  // namespace clatter
