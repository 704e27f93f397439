// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/h5_slab.hpp"

#include "core/base/h5_impl.hpp"

namespace clatter {
namespace {

/// A dataset of a file that is opened for it.
class OpenDataset {
 public:
  OpenDataset(const std::filesystem::path& path, const std::string& name)
      : path_(path),
        name_(name),
        reading_(path),
        file_((silence_library(), H5Fopen(path.c_str(), H5F_ACC_RDONLY, unlocked_access())),
              &H5Fclose),
        set_(file_.ok() ? H5Dopen2(file_, name.c_str(), H5P_DEFAULT) : -1, &H5Dclose) {
    if (!file_.ok()) refuse("cannot be opened");
    if (!set_.ok()) refuse("found nothing, expected a dataset");
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}: {}: {}", path_.string(), name_, what));
  }
  /// The extents; false when there are not `count` of them.
  bool extents(int count, hsize_t* values) const {
    const Id space(H5Dget_space(set_), &H5Sclose);
    return H5Sget_simple_extent_ndims(space) == count &&
           H5Sget_simple_extent_dims(space, values, nullptr) == count;
  }
  bool is(H5T_class_t kind) const {
    const Id type(H5Dget_type(set_), &H5Tclose);
    return H5Tget_class(type) == kind;
  }
  /// `size` values from `start` on, each with as many numbers as the dataset has dimensions.
  void read(int dimensions, const hsize_t* start, const hsize_t* size, hid_t type,
            void* values) const {
    const Id space(H5Dget_space(set_), &H5Sclose);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, size, nullptr);
    const Id memory(H5Screate_simple(dimensions, size, nullptr), &H5Sclose);
    if (H5Dread(set_, type, memory, space, H5P_DEFAULT, values) < 0)
      refuse("cannot be read, the file is damaged");
  }

 private:
  const std::filesystem::path& path_;
  const std::string& name_;
  ReadLock reading_;
  Id file_, set_;
};

template <class T>
std::vector<T> read_list_part(const std::filesystem::path& path, const std::string& name,
                              H5T_class_t kind, int64_t first, int64_t count) {
  const OpenDataset set(path, name);
  hsize_t extent = 0;
  if (!set.extents(1, &extent) || !set.is(kind) || first < 0 || count < 0 ||
      first + count > static_cast<int64_t>(extent))
    set.refuse(
        fmt::format("found {} numbers, expected a list of {} or more", extent, first + count));
  std::vector<T> values(static_cast<size_t>(count));
  const auto start = static_cast<hsize_t>(first), size = static_cast<hsize_t>(count);
  if (count > 0)
    set.read(1, &start, &size, kind == H5T_INTEGER ? H5T_NATIVE_INT32 : H5T_NATIVE_DOUBLE,
             values.data());
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
  const OpenDataset set(path, name);
  hsize_t extents[3] = {0, 0, 0};
  if (!set.extents(3, extents) || index < 0 || static_cast<hsize_t>(index) >= extents[0])
    set.refuse(
        fmt::format("expected three dimensions, the first above {}, found {}", index, extents[0]));
  RowMatrix values(static_cast<Eigen::Index>(extents[1]), static_cast<Eigen::Index>(extents[2]));
  if (values.size() == 0) return values;
  const hsize_t start[3] = {static_cast<hsize_t>(index), 0, 0};
  const hsize_t size[3] = {1, extents[1], extents[2]};
  set.read(3, start, size, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

}  // namespace clatter
