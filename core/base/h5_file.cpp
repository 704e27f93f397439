// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/h5_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstring>

#include "core/base/h5_impl.hpp"

namespace clatter {
namespace {

// Largest attribute in an object header (limit 65 535 bytes with name and type).
constexpr size_t kLongestAttribute = 60000;

std::string member(std::string_view object, std::string_view name) {
  return object == "/" ? std::string(name) : fmt::format("{}/{}", object, name);
}

}  // namespace

H5File::H5File(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
H5File::H5File(H5File&&) noexcept = default;
H5File& H5File::operator=(H5File&&) noexcept = default;
H5File::~H5File() = default;

H5File H5File::open(const std::filesystem::path& path) {
  silence_library();
  auto impl = std::make_unique<Impl>();
  impl->final_path = path;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw InputError(fmt::format("{}: no such file, expected an HDF5 file", path.string()));
  }
  impl->reading = ReadLock(path);
  impl->file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, unlocked_access());
  if (impl->file < 0) {
    const std::string why = damage();
    throw InputError(fmt::format(
        "{}: {}", path.string(),
        why.starts_with("checksum")
            ? why
            : "cannot be opened, expected a complete HDF5 file (truncated, or not HDF5)"));
  }
  return H5File(std::move(impl));
}

H5File H5File::create(const std::filesystem::path& path) {
  silence_library();
  auto impl = std::make_unique<Impl>();
  impl->final_path = path;
  std::filesystem::path part = path;
  part += ".part";
  impl->lock = PartLock(part);
  impl->part_path = part;
  const Id access = checked_access(), creation = checked_creation(H5P_FILE_CREATE);
  impl->unfinished = PartName(part);
  impl->file = H5Fcreate(part.c_str(), H5F_ACC_TRUNC, creation, access);
  if (impl->file < 0) {
    throw FileError(fmt::format(
        "{}: cannot be created (folder missing, no permission or disk full)", part.string()));
  }
  return H5File(std::move(impl));
}

void H5File::complete() {
  if (impl_->file < 0) return;
  const auto part = impl_->part_path;
  const bool flushed = H5Fflush(impl_->file, H5F_SCOPE_GLOBAL) >= 0;
  const bool closed = H5Fclose(std::exchange(impl_->file, -1)) >= 0;
  if (!flushed || !closed) impl_->refuse_part("written");
  const int descriptor = ::open(part.c_str(), O_RDWR);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  if (descriptor >= 0) ::close(descriptor);
  if (!synced) impl_->refuse_part("synced");
}

void H5File::commit() {
  complete();
  if (std::rename(impl_->part_path.c_str(), impl_->final_path.c_str()) != 0)
    impl_->refuse_part("renamed");
  impl_->part_path.clear();
  impl_->lock = PartLock();  // readers of the finished file are not kept out
}

void H5File::commit(const std::filesystem::path& final_path) {
  impl_->final_path = final_path;
  commit();
}

const std::filesystem::path& H5File::path() const { return impl_->final_path; }

bool H5File::has(std::string_view name) const { return impl_->exists(std::string(name)); }

bool H5File::has_attribute(std::string_view object, std::string_view name) const {
  if (!has(object)) return false;
  return impl_->has_attribute(impl_->open_object(object), object, name);
}

std::vector<std::string> H5File::list(std::string_view group) const {
  std::vector<std::string> names;
  if (!has(group)) return names;
  const Id owner = impl_->open_object(group);
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  if (H5Literate(owner, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names) < 0)
    impl_->refuse(group, damage());
  return names;
}

std::vector<int64_t> H5File::shape(std::string_view name) const {
  return Impl::extents(impl_->open_dataset(name));
}

void H5File::write(std::string_view name, const std::vector<double>& values) {
  impl_->write(name, values.data(), {static_cast<int64_t>(values.size())});
}
void H5File::write(std::string_view name, const std::vector<int32_t>& values) {
  impl_->write(name, values.data(), {static_cast<int64_t>(values.size())});
}
void H5File::write(std::string_view name, const std::vector<int64_t>& values) {
  impl_->write(name, values.data(), {static_cast<int64_t>(values.size())});
}
void H5File::write(std::string_view name, const Eigen::VectorXd& values) {
  impl_->write(name, values.data(), {values.size()});
}
void H5File::write(std::string_view name, const Eigen::MatrixXd& values) {
  write(name, RowMatrix(values));
}
void H5File::write(std::string_view name, const RowMatrix& values) {
  impl_->write(name, values.data(), {values.rows(), values.cols()});
}
void H5File::write(std::string_view name, const IndexMatrix& values) {
  impl_->write(name, values.data(), {values.rows(), values.cols()});
}
void H5File::write_float(std::string_view name, const std::vector<float>& values,
                         const std::vector<int64_t>& shape) {
  impl_->write(name, values.data(), shape);
}

void H5File::create(std::string_view name, const std::vector<int64_t>& shape, bool single) {
  impl_->create(name, single ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE, shape);
}

void H5File::write_part(std::string_view name, int64_t first, const float* values, int64_t count) {
  impl_->write_part(name, H5T_NATIVE_FLOAT, first, values, count);
}
void H5File::write_part(std::string_view name, int64_t first, const double* values, int64_t count) {
  impl_->write_part(name, H5T_NATIVE_DOUBLE, first, values, count);
}

int64_t H5File::rows_of_a_chunk(const std::vector<int64_t>& shape, bool single) {
  if (std::find(shape.begin(), shape.end(), int64_t{0}) != shape.end()) return 1;
  const size_t bytes_each = single ? sizeof(float) : sizeof(double);
  return static_cast<int64_t>(chunk_of({shape.begin(), shape.end()}, bytes_each).front());
}

void H5File::begin_disk_writes() {
  const int descriptor = ::open(impl_->part_path.c_str(), O_RDWR);
  if (descriptor < 0) return;  // nothing depends on it
  ::sync_file_range(descriptor, 0, 0, SYNC_FILE_RANGE_WRITE);
  ::close(descriptor);
}

void H5File::store_single(bool single) { impl_->single = single; }

// Fixed length: strings of variable length are in a heap without checksums.
void H5File::write(std::string_view name, const std::vector<std::string>& values) {
  size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  std::string bytes(values.size() * length, '\0');
  for (size_t i = 0; i < values.size(); ++i) values[i].copy(&bytes[i * length], length);
  impl_->write(name, string_type(length), bytes.data(), {static_cast<int64_t>(values.size())});
}

std::vector<double> H5File::read_doubles(std::string_view name) const {
  return impl_->read<double>(name, 1);
}
std::vector<int32_t> H5File::read_ints(std::string_view name) const {
  return impl_->read<int32_t>(name, 1);
}
std::vector<int64_t> H5File::read_longs(std::string_view name) const {
  return impl_->read<int64_t>(name, 1);
}

std::vector<std::string> H5File::read_strings(std::string_view name) const {
  const Id set = impl_->open_dataset(name);
  const Id stored(H5Dget_type(set), &H5Tclose);
  const auto shape = Impl::extents(set);
  if (shape.size() != 1 || H5Tget_class(stored) != H5T_STRING) {
    impl_->refuse(name, "found another type, expected a list of strings");
  }
  const auto count = static_cast<size_t>(shape[0]);
  return H5Tis_variable_str(stored) > 0 ? impl_->read_long_texts(name, set, count)
                                        : impl_->read_texts(name, set, stored, count);
}

std::vector<std::string> H5File::read_byte_texts(std::string_view name) const {
  const Id set = impl_->open_dataset(name);
  const Id stored(H5Dget_type(set), &H5Tclose);
  const auto shape = Impl::extents(set);
  const size_t length = H5Tget_size(stored);
  constexpr size_t kLongest = 4096, kMost = size_t{1} << 26;  // bytes of one, of all
  const bool bytes = H5Tget_class(stored) == H5T_ARRAY && H5Tget_array_ndims(stored) == 1 &&
                     length <= kLongest && shape.size() == 1 &&
                     static_cast<size_t>(shape[0]) * length <= kMost;
  hsize_t extent = 0;
  if (!bytes || H5Tget_array_dims2(stored, &extent) < 0 || extent != length) {
    impl_->refuse(name, "found another type, expected a list of arrays of bytes");
  }
  std::string all(static_cast<size_t>(shape[0]) * length, '\0');
  if (H5Dread(set, stored, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()) < 0) {
    impl_->refuse(name, damage());
  }
  std::vector<std::string> texts;
  for (size_t at = 0; at < all.size(); at += length) {
    std::string text(all.data() + at, strnlen(all.data() + at, length));
    text.erase(text.find_last_not_of(' ') + 1);
    texts.push_back(std::move(text));
  }
  return texts;
}

Eigen::VectorXd H5File::read_vector(std::string_view name) const {
  const auto values = read_doubles(name);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::MatrixXd H5File::read_matrix(std::string_view name) const { return read_rows(name); }

RowMatrix H5File::read_rows(std::string_view name) const {
  const auto values = impl_->read<double>(name, 2);
  const auto extents = shape(name);
  return Eigen::Map<const RowMatrix>(values.data(), extents[0], extents[1]);
}

RowMatrix H5File::read_rows(std::string_view name, int64_t first, int64_t count) const {
  RowMatrix values;
  read_rows(name, first, count, values);
  return values;
}

void H5File::read_rows(std::string_view name, int64_t first, int64_t count,
                       RowMatrix& values) const {
  const Id set = impl_->open_dataset(name);
  const auto extents = Impl::extents(set);
  if (extents.size() != 2 || first < 0 || count < 0 || first + count > extents[0]) {
    impl_->refuse(name, fmt::format("rows {} to {} requested, the dataset has {}", first,
                                    first + count, extents.empty() ? 0 : extents[0]));
  }
  impl_->check_number_class(name, set, false);
  values.resize(count, extents[1]);
  if (values.size() == 0) return;
  const Id space(H5Dget_space(set), &H5Sclose);
  const hsize_t start[2] = {static_cast<hsize_t>(first), 0};
  const hsize_t size[2] = {static_cast<hsize_t>(count), static_cast<hsize_t>(extents[1])};
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, size, nullptr);
  const Id memory(H5Screate_simple(2, size, nullptr), &H5Sclose);
  if (H5Dread(set, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()) < 0)
    impl_->refuse(name, damage());
}

IndexMatrix H5File::read_index_matrix(std::string_view name) const {
  const auto values = impl_->read<int32_t>(name, 2);
  const auto extents = shape(name);
  return Eigen::Map<const IndexMatrix>(values.data(), extents[0], extents[1]);
}

void H5File::set(std::string_view object, std::string_view name, double value) {
  impl_->set_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}
void H5File::set(std::string_view object, std::string_view name, int64_t value) {
  impl_->set_attribute(object, name, H5T_NATIVE_INT64, &value);
}
void H5File::set(std::string_view object, std::string_view name,
                 const std::vector<int64_t>& values) {
  impl_->set_attribute(object, name, H5T_NATIVE_INT64, values.data(),
                       static_cast<int64_t>(values.size()));
}
// Fixed length, for the same reason as in write().
void H5File::set(std::string_view object, std::string_view name, const std::string& value) {
  if (value.size() > kLongestAttribute)
    return write(member(object, name), std::vector<std::string>{value});
  std::string bytes = value;
  bytes.resize(std::max<size_t>(bytes.size(), 1), '\0');
  impl_->set_attribute(object, name, string_type(bytes.size()), bytes.data());
}

double H5File::get_double(std::string_view object, std::string_view name) const {
  return impl_->number_attribute<double>(object, name);
}
int64_t H5File::get_int(std::string_view object, std::string_view name) const {
  return impl_->number_attribute<int64_t>(object, name);
}
std::vector<int64_t> H5File::get_ints(std::string_view object, std::string_view name) const {
  return impl_->number_attributes<int64_t>(object, name);
}

std::string H5File::get_string(std::string_view object, std::string_view name) const {
  if (has_attribute(object, name) || !has(member(object, name)))
    return impl_->text_attribute(object, name);
  const std::vector<std::string> values = read_strings(member(object, name));
  if (values.size() != 1)
    impl_->refuse(member(object, name), fmt::format("found {} strings, expected 1", values.size()));
  return values.front();
}

std::vector<std::string> H5File::attributes(std::string_view object) const {
  const Id owner = impl_->open_object(object);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  hsize_t index = 0;
  if (H5Aiterate2(owner, H5_INDEX_NAME, H5_ITER_INC, &index, collect, &names) < 0)
    impl_->refuse(object, damage());
  return names;
}

}  // namespace clatter
