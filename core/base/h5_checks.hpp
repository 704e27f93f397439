// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Checksums in HDF5 files: settings for writing, and the message for a failed read.
// Included by core/base/h5_*.cpp only.
#include <hdf5.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clatter {

/// Owns one HDF5 identifier.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Id& operator=(Id&&) = delete;
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  bool ok() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// File access with checksums on all metadata: object headers, names, indices.
inline Id checked_access() {
  Id access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_file_locking(access, false, true);  // PartLock does it, before the file is truncated
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  return access;
}

/// File access without the library's locks, which need a file system that has them (hard case H3):
/// ReadLock and PartLock do the locking.
inline Id unlocked_access() {
  Id access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  H5Pset_file_locking(access, false, true);
  return access;
}

/// Creation properties of a dataset, a group or a file (`kind` H5P_DATASET_CREATE, ...) that keep
/// the attributes in the object header, which has a checksum. By default HDF5 moves more than 8 of
/// them to a heap, where those over 4 KiB have none.
inline Id checked_creation(hid_t kind) {
  Id creation(H5Pcreate(kind), &H5Pclose);
  H5Pset_attr_phase_change(creation, 1000, 900);
  return creation;
}

/// Extents of a chunk: complete rows, about 128 KiB, so that several chunks fit into the library's
/// cache.
inline std::vector<hsize_t> chunk_of(std::vector<hsize_t> extents, size_t bytes_each) {
  hsize_t left = std::max<hsize_t>(131072 / std::max<size_t>(bytes_each, 1), 1);
  for (size_t d = extents.size(); d-- > 0;) {
    extents[d] = std::min(extents[d], left);
    left = std::max<hsize_t>(left / extents[d], 1);
  }
  return extents;
}

/// Dataset layout in chunks with a Fletcher32 checksum each, which the library verifies on reading.
/// An empty dataset has no chunks.
inline Id checked_layout(const std::vector<hsize_t>& extents, size_t bytes_each) {
  Id layout = checked_creation(H5P_DATASET_CREATE);
  if (std::find(extents.begin(), extents.end(), hsize_t{0}) != extents.end()) return layout;
  const std::vector<hsize_t> chunk = chunk_of(extents, bytes_each);
  H5Pset_chunk(layout, static_cast<int>(chunk.size()), chunk.data());
  H5Pset_fletcher32(layout);
  H5Pset_fill_time(layout, H5D_FILL_TIME_NEVER);  // every chunk is written
  return layout;
}

/// Cause of the last HDF5 failure; call it before any other HDF5 function. HDF5 1.10 names the
/// checksum of a chunk, 1.14 only the filter: the checksum is the one that artefacts have.
inline std::string damage() {
  bool checksum = false;
  const auto look = [](unsigned, const H5E_error2_t* error, void* found) -> herr_t {
    const std::string_view text = error->desc;
    for (const char* sign : {"checksum", "filter returned failure"})
      if (text.find(sign) != std::string_view::npos) *static_cast<bool*>(found) = true;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, look, &checksum);
  return checksum ? "checksum does not match: the file was damaged after it was written"
                  : "cannot be read, the file is damaged";
}

}  // namespace clatter
