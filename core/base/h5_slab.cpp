// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/h5_slab.hpp"

#include "core/base/h5_impl.hpp"

namespace clatter {
namespace {

template <class T>
std::vector<T> read_list_part(const std::filesystem::path& path, const std::string& name,
                              H5T_class_t kind, int64_t first, int64_t count) {
  silence_library();
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}: {}", path.string(), name, what));
  };
  const Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
  if (!file.ok()) refuse("cannot be opened");
  const Id set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), &H5Dclose);
  if (!set.ok()) refuse("found nothing, expected a dataset");
  const Id type(H5Dget_type(set), &H5Tclose), space(H5Dget_space(set), &H5Sclose);
  hsize_t extent = 0;
  const bool list = H5Sget_simple_extent_ndims(space) == 1 && H5Tget_class(type) == kind;
  if (list) H5Sget_simple_extent_dims(space, &extent, nullptr);
  if (!list || first < 0 || count < 0 || first + count > static_cast<int64_t>(extent))
    refuse(fmt::format("found {} numbers, expected a list of {} or more", extent, first + count));
  std::vector<T> values(static_cast<size_t>(count));
  if (count == 0) return values;
  const hsize_t start = static_cast<hsize_t>(first), size = static_cast<hsize_t>(count);
  H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, nullptr, &size, nullptr);
  const Id memory(H5Screate_simple(1, &size, nullptr), &H5Sclose);
  const hid_t native = kind == H5T_INTEGER ? H5T_NATIVE_INT32 : H5T_NATIVE_DOUBLE;
  if (H5Dread(set, native, memory, space, H5P_DEFAULT, values.data()) < 0)
    refuse("cannot be read, the file is damaged");
  return values;
}

}  // namespace

std::vector<double> read_part_of_doubles(const std::filesystem::path& path, const std::string& name,
                                         int64_t first, int64_t count) {
  return read_list_part<double>(path, name, H5T_FLOAT, first, count);
}

std::vector<int32_t> read_part_of_ints(const std::filesystem::path& path, const std::string& name,
                                       int64_t first, int64_t count) {
  return read_list_part<int32_t>(path, name, H5T_INTEGER, first, count);
}

RowMatrix read_slab(const std::filesystem::path& path, const std::string& name, int64_t index) {
  silence_library();
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}: {}", path.string(), name, what));
  };
  const Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
  if (!file.ok()) refuse("cannot be opened");
  const Id set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), &H5Dclose);
  if (!set.ok()) refuse("found nothing, expected a dataset");
  const Id space(H5Dget_space(set), &H5Sclose);
  hsize_t extents[3] = {0, 0, 0};
  const bool fits = H5Sget_simple_extent_ndims(space) == 3 &&
                    H5Sget_simple_extent_dims(space, extents, nullptr) == 3;
  if (!fits || index < 0 || static_cast<hsize_t>(index) >= extents[0])
    refuse(
        fmt::format("expected three dimensions, the first above {}, found {}", index, extents[0]));
  RowMatrix values(static_cast<Eigen::Index>(extents[1]), static_cast<Eigen::Index>(extents[2]));
  if (values.size() == 0) return values;
  const hsize_t start[3] = {static_cast<hsize_t>(index), 0, 0};
  const hsize_t size[3] = {1, extents[1], extents[2]};
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, size, nullptr);
  const Id memory(H5Screate_simple(3, size, nullptr), &H5Sclose);
  if (H5Dread(set, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()) < 0)
    refuse("cannot be read, the file is damaged");
  return values;
}

}  // namespace clatter
