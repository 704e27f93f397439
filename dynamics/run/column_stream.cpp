// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/column_stream.hpp"

#include <cassert>

#include "core/run/run_layout.hpp"

namespace clatter::dynamics {

void ColumnStream::add_column(const std::string& name, const std::string& unit) {
  assert(rows_ == 0);
  names_.push_back(name);
  units_.push_back(unit);
  values_.emplace_back();
}

void ColumnStream::add(const std::vector<double>& row) {
  assert(row.size() == names_.size());
  for (size_t i = 0; i < names_.size(); ++i) values_[i].push_back(row[i]);
  ++rows_;
  if (values_.front().size() == kRows) flush();
}

void ColumnStream::flush() {
  for (size_t i = 0; i < names_.size(); ++i) {
    const std::string name = run::path(group_, names_[i]);
    const bool is_new = !file_.has(name);
    file_.append(name, values_[i]);
    if (is_new) file_.set(name, "unit", units_[i]);
    values_[i].clear();
  }
}

void ColumnStream::finish() { flush(); }

int64_t ColumnStream::held() const {
  size_t sum = 0;
  for (const auto& column : values_) sum += column.size();
  return static_cast<int64_t>(sum);
}

}  // namespace clatter::dynamics
