// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/h5_slab.hpp"

#include "core/base/h5_impl.hpp"

namespace clatter {

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
