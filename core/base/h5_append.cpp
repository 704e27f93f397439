// SPDX-License-Identifier: GPL-3.0-or-later
// Datasets that grow while a file is written, and that are copied.
#include "core/base/h5_file.hpp"

#include <cassert>

#include "core/base/h5_impl.hpp"

namespace clatter {
namespace {

/// A dataset of no rows yet, unlimited along its first dimension, in chunks of `shape`.
Id growing_dataset(hid_t file, const std::string& path, hid_t type,
                   const std::vector<hsize_t>& shape) {
  std::vector<hsize_t> now = shape, most = shape;
  now[0] = 0;
  most[0] = H5S_UNLIMITED;
  const Id space(H5Screate_simple(static_cast<int>(now.size()), now.data(), most.data()),
                 &H5Sclose);
  const Id layout = checked_layout(shape, H5Tget_size(type));
  return Id(H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT),
            &H5Dclose);
}

}  // namespace

void H5File::Impl::append(std::string_view name, hid_t type, const void* values,
                          const std::vector<int64_t>& shape) {
  const std::string path(name);
  const bool empty = std::find(shape.begin(), shape.end(), int64_t{0}) != shape.end();
  if (empty) {
    if (!exists(path)) write(name, type, values, shape);
    return;
  }
  const std::vector<hsize_t> rows(shape.begin(), shape.end());
  ensure_group(parent_of(path));
  const Id set = exists(path) ? open_dataset(name) : growing_dataset(file, path, type, rows);
  if (!set.ok()) fail_write(name);
  std::vector<int64_t> before = extents(set);
  std::vector<hsize_t> begin(rows.size(), 0), after = rows;
  begin[0] = static_cast<hsize_t>(before[0]);
  after[0] += begin[0];
  before[0] = shape[0];
  assert(before == shape);  // rows of the same extents
  if (H5Dset_extent(set, after.data()) < 0) fail_write(name);
  const Id memory(H5Screate_simple(static_cast<int>(rows.size()), rows.data(), nullptr), &H5Sclose);
  const Id space(H5Dget_space(set), &H5Sclose);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, rows.data(), nullptr);
  // Flushed here, because a full disk must not first be noticed when the dataset is closed.
  if (H5Dwrite(set, type, memory, space, H5P_DEFAULT, values) < 0 || H5Dflush(set) < 0)
    fail_write(name);
}

void H5File::append(std::string_view name, const std::vector<double>& values) {
  impl_->append(name, H5T_NATIVE_DOUBLE, values.data(), {static_cast<int64_t>(values.size())});
}

void H5File::append(std::string_view name, const RowMatrix& rows) {
  impl_->append(name, H5T_NATIVE_DOUBLE, rows.data(), {rows.rows(), rows.cols()});
}

void H5File::append_float(std::string_view name, const std::vector<float>& values,
                          const std::vector<int64_t>& shape) {
  impl_->append(name, H5T_NATIVE_FLOAT, values.data(), shape);
}

void H5File::copy(const H5File& from, std::string_view source, std::string_view group) {
  const auto member = [](std::string_view owner, const std::string& name) {
    return owner == "/" ? name : fmt::format("{}/{}", owner, name);
  };
  if (group != "/") impl_->ensure_group(std::string(group));
  for (const std::string& name : from.list(source)) {
    const std::string path = member(group, name);
    if (has(path) && H5Ldelete(impl_->file, path.c_str(), H5P_DEFAULT) < 0) impl_->fail_write(path);
    if (H5Ocopy(from.impl_->file, member(source, name).c_str(), impl_->file, path.c_str(),
                H5P_DEFAULT, H5P_DEFAULT) < 0) {
      const std::string why = damage();
      if (why.starts_with("checksum")) from.impl_->refuse(member(source, name), why);
      impl_->fail_write(path);
    }
  }
  // HDF5 1.14.5 cannot flush one dataset, as append() does, while others that were copied are in
  // its cache ("slist not empty").
  if (H5Fflush(impl_->file, H5F_SCOPE_LOCAL) < 0) impl_->fail_write(group);
}

}  // namespace clatter
