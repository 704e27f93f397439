// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Implementation of h5_file: RAII identifiers and typed access. Included by core/base/h5_*.cpp
// only, so that HDF5 types stay hidden.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/h5_checks.hpp"
#include "core/base/h5_file.hpp"
#include "core/base/part_lock.hpp"
#include "core/base/part_names.hpp"
#include "core/base/read_lock.hpp"

namespace clatter {

inline void silence_library() {
  // HDF5's error stack is replaced by our one-line messages.
  static const bool once = [] {
    // After a full disk HDF5's clean-up at exit crashes (1.10.8); we close files ourselves.
    H5dont_atexit();
    H5check_version(H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE);  // hard case H6
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  (void)once;
}

template <class T>
hid_t memory_type();
template <>
inline hid_t memory_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t memory_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t memory_type<int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
inline hid_t memory_type<int64_t>() {
  return H5T_NATIVE_INT64;
}

/// UTF-8 of variable length, or of `length` bytes, padded with zeros.
inline Id string_type(size_t length = H5T_VARIABLE) {
  Id type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type, length);
  H5Tset_cset(type, H5T_CSET_UTF8);
  if (length != H5T_VARIABLE) H5Tset_strpad(type, H5T_STR_NULLPAD);
  return type;
}

struct H5File::Impl {
  std::filesystem::path final_path;
  std::filesystem::path part_path;  // empty when reading
  PartName unfinished;
  PartLock lock;
  ReadLock reading;
  hid_t file = -1;
  bool single = false;  // doubles are stored in single precision

  ~Impl() {
    if (file >= 0) H5Fclose(file);
    std::error_code ignored;
    if (!part_path.empty()) std::filesystem::remove(part_path, ignored);
  }

  std::string at(std::string_view name) const {
    return fmt::format("{}: {}", final_path.string(), name);
  }
  [[noreturn]] void refuse_part(const char* what) const {
    throw FileError(
        fmt::format("{}: cannot be {} (disk full or no permission?)", part_path.string(), what));
  }

  [[noreturn]] void refuse(std::string_view name, const std::string& what) const {
    throw InputError(fmt::format("{}: {}", at(name), what));
  }
  [[noreturn]] void fail_write(std::string_view name) const {
    throw FileError(fmt::format("{}: cannot be written (disk full or no permission?)", at(name)));
  }

  bool exists(const std::string& name) const {
    if (name.empty() || name == "/") return true;
    for (size_t slash = name.find('/'); slash != std::string::npos;
         slash = name.find('/', slash + 1)) {
      if (slash > 0 && !linked(name.substr(0, slash))) return false;
    }
    return linked(name);
  }

  /// Whether the parent group has this member.
  bool linked(const std::string& name) const {
    const htri_t exists = H5Lexists(file, name.c_str(), H5P_DEFAULT);
    if (exists < 0) refuse(name, damage());
    return exists > 0;
  }

  Id open_dataset(std::string_view name) const {
    const std::string path(name);
    if (!exists(path)) refuse(name, "found nothing, expected a dataset");
    Id set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), &H5Dclose);
    if (!set.ok()) {
      const std::string why = damage();
      refuse(name, is_group(path) ? "found a group, expected a dataset" : why);
    }
    return set;
  }

  bool is_group(const std::string& path) const {
    const Id group(H5Gopen2(file, path.c_str(), H5P_DEFAULT), &H5Gclose);
    return group.ok();
  }

  static std::vector<int64_t> extents(hid_t set) {
    const Id space(H5Dget_space(set), &H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank <= 0) return {};
    std::vector<hsize_t> raw(static_cast<size_t>(rank));
    H5Sget_simple_extent_dims(space, raw.data(), nullptr);
    return {raw.begin(), raw.end()};
  }

  template <class T>
  void write(std::string_view name, const T* values, const std::vector<int64_t>& shape) {
    write(name, memory_type<T>(), values, shape);
  }

  void write(std::string_view name, hid_t type, const void* values,
             const std::vector<int64_t>& shape) {
    const bool narrow = single && H5Tequal(type, H5T_NATIVE_DOUBLE) > 0;
    const Id set = create(name, narrow ? H5T_NATIVE_FLOAT : type, shape);
    const bool empty = std::find(shape.begin(), shape.end(), int64_t{0}) != shape.end();
    if (!empty && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail_write(name);
  }

  /// A new dataset without values.
  Id create(std::string_view name, hid_t type, const std::vector<int64_t>& shape) {
    const std::string path(name);
    const std::vector<hsize_t> dims(shape.begin(), shape.end());
    const Id space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr),
                   &H5Sclose);
    ensure_group(parent_of(path));
    const Id layout = checked_layout(dims, H5Tget_size(type));
    Id set(H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT),
           &H5Dclose);
    if (!set.ok()) fail_write(name);
    return set;
  }

  /// `count` values from row `first` of a dataset on.
  void write_part(std::string_view name, hid_t type, int64_t first, const void* values,
                  int64_t count) {
    const Id set = open_dataset(name);
    std::vector<int64_t> shape = extents(set);
    int64_t row = 1;
    for (size_t d = 1; d < shape.size(); ++d) row *= shape[d];
    shape[0] = row > 0 ? count / row : 0;
    const std::vector<hsize_t> size(shape.begin(), shape.end());
    std::vector<hsize_t> start(size.size(), 0);
    start[0] = static_cast<hsize_t>(first);
    const Id space(H5Dget_space(set), &H5Sclose);
    const Id memory(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                    &H5Sclose);
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) <
            0 ||
        H5Dwrite(set, type, memory, space, H5P_DEFAULT, values) < 0)
      fail_write(name);
  }

  /// Appends rows along the first dimension; the first call creates the dataset.
  void append(std::string_view name, hid_t type, const void* values,
              const std::vector<int64_t>& shape);

  template <class T>
  std::vector<T> read(std::string_view name, size_t rank) const {
    const Id set = open_dataset(name);
    const auto shape = extents(set);
    if (shape.size() != rank) {
      refuse(name, fmt::format("found {} dimensions, expected {}", shape.size(), rank));
    }
    check_number_class(name, set, std::is_integral_v<T>);
    int64_t count = 1;
    for (const int64_t extent : shape) count *= extent;
    std::vector<T> values(static_cast<size_t>(count));
    if (count > 0 &&
        H5Dread(set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
      refuse(name, damage());
    }
    return values;
  }

  /// Strings of fixed length.
  std::vector<std::string> read_texts(std::string_view name, hid_t set, hid_t stored,
                                      size_t count) const {
    const size_t length = H5Tget_size(stored);
    std::string bytes(count * length, '\0');
    if (count > 0 && H5Dread(set, stored, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
      refuse(name, damage());
    std::vector<std::string> values;
    for (size_t i = 0; i < count; ++i)
      values.emplace_back(&bytes[i * length], strnlen(&bytes[i * length], length));
    return values;
  }

  /// Strings of variable length, as h5py and earlier versions of clatter write them.
  std::vector<std::string> read_long_texts(std::string_view name, hid_t set, size_t count) const {
    std::vector<char*> pointers(count, nullptr);
    if (pointers.empty()) return {};
    const Id type = string_type();
    if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) < 0)
      refuse(name, damage());
    std::vector<std::string> values;
    for (const char* pointer : pointers) values.emplace_back(pointer == nullptr ? "" : pointer);
    const Id space(H5Dget_space(set), &H5Sclose);
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
    return values;
  }

  void check_number_class(std::string_view name, hid_t set, bool integral) const {
    const Id type(H5Dget_type(set), &H5Tclose);
    const H5T_class_t found = H5Tget_class(type);
    const bool fits = found == H5T_INTEGER || (!integral && found == H5T_FLOAT);
    if (!fits) {
      refuse(name, fmt::format("found another type, expected {}",
                               integral ? "whole numbers" : "numbers"));
    }
  }

  Id open_object(std::string_view object) const {
    const std::string path(object);
    if (!exists(path)) refuse(object, "found nothing, expected a group or dataset");
    Id found(H5Oopen(file, path.c_str(), H5P_DEFAULT), &H5Oclose);
    if (!found.ok()) refuse(object, damage());
    return found;
  }

  bool has_attribute(hid_t owner, std::string_view object, std::string_view name) const {
    const htri_t exists = H5Aexists(owner, std::string(name).c_str());
    if (exists < 0) refuse(object, damage());
    return exists > 0;
  }

  /// Creates `object` and its parent groups where missing.
  void ensure_group(const std::string& object) {
    if (object.empty() || object == "/" || exists(object)) return;
    ensure_group(parent_of(object));
    const Id creation = checked_creation(H5P_GROUP_CREATE);
    const Id group(H5Gcreate2(file, object.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), &H5Gclose);
    if (!group.ok()) fail_write(object);
  }

  static std::string parent_of(const std::string& path) {
    return path.substr(0, path.rfind('/') == std::string::npos ? 0 : path.rfind('/'));
  }

  /// `extent` < 0: a scalar, otherwise a list of that length.
  void set_attribute(std::string_view object, std::string_view name, hid_t type, const void* value,
                     int64_t extent = -1) {
    ensure_group(std::string(object));
    const Id owner = open_object(object);
    const std::string key(name);
    if (H5Aexists(owner, key.c_str()) > 0) H5Adelete(owner, key.c_str());
    const auto length = static_cast<hsize_t>(extent);
    const Id space(extent < 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &length, nullptr),
                   &H5Sclose);
    const Id attribute(H5Acreate2(owner, key.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                       &H5Aclose);
    if (!attribute.ok() || H5Awrite(attribute, type, value) < 0) fail_write(object);
  }

  Id open_attribute(std::string_view object, std::string_view name) const {
    const Id owner = open_object(object);
    if (!has_attribute(owner, object, name)) {
      refuse(object, fmt::format("found no attribute {}, expected one", name));
    }
    Id attribute(H5Aopen(owner, std::string(name).c_str(), H5P_DEFAULT), &H5Aclose);
    if (!attribute.ok()) refuse(object, fmt::format("attribute {}: {}", name, damage()));
    return attribute;
  }

  std::string text_attribute(std::string_view object, std::string_view name) const {
    const Id attribute = open_attribute(object, name);
    const Id stored(H5Aget_type(attribute), &H5Tclose);
    const Id space(H5Aget_space(attribute), &H5Sclose);
    if (H5Tget_class(stored) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1)
      refuse(object, fmt::format("attribute {} is not a string", name));
    const auto cannot = [&] { refuse(object, fmt::format("attribute {}: {}", name, damage())); };
    if (H5Tis_variable_str(stored) > 0) {  // written by h5py or earlier versions of clatter
      const Id type = string_type();
      char* pointer = nullptr;
      if (H5Aread(attribute, type, &pointer) < 0) cannot();
      const std::string value = pointer == nullptr ? "" : pointer;
      H5free_memory(pointer);
      return value;
    }
    std::string bytes(H5Tget_size(stored), '\0');
    if (H5Aread(attribute, stored, bytes.data()) < 0) cannot();
    return bytes.substr(0, bytes.find('\0'));
  }

  template <class T>
  std::vector<T> number_attributes(std::string_view object, std::string_view name) const {
    const Id attribute = open_attribute(object, name);
    const Id type(H5Aget_type(attribute), &H5Tclose);
    const Id space(H5Aget_space(attribute), &H5Sclose);
    const H5T_class_t found = H5Tget_class(type);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    std::vector<T> values(static_cast<size_t>(std::max<hssize_t>(count, 0)));
    if ((found != H5T_INTEGER && found != H5T_FLOAT) || count < 1 ||
        H5Aread(attribute, memory_type<T>(), values.data()) < 0) {
      refuse(object, fmt::format("attribute {} is not a number", name));
    }
    return values;
  }

  template <class T>
  T number_attribute(std::string_view object, std::string_view name) const {
    const std::vector<T> values = number_attributes<T>(object, name);
    if (values.size() != 1) {
      refuse(object, fmt::format("attribute {} has {} numbers, expected 1", name, values.size()));
    }
    return values.front();
  }
};

}  // namespace clatter
