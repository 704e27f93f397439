// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/plain_h5.hpp"

#include <fcntl.h>
#include <unistd.h>

#include "core/base/h5_impl.hpp"

namespace clatter {

struct PlainH5::Impl {
  std::filesystem::path path, part;
  PartLock lock;
  PartName unfinished;
  hid_t file = -1;

  ~Impl() {
    if (file >= 0) H5Fclose(file);
    std::error_code ignored;
    if (!part.empty()) std::filesystem::remove(part, ignored);
  }

  void require(bool good, const std::string& name) const {
    if (!good)
      throw FileError(fmt::format("{}: {}: cannot be written (disk full or no permission?)",
                                  path.string(), name));
  }

  void write(const std::string& name, hid_t type, hsize_t count, const void* values) const {
    const Id links(H5Pcreate(H5P_LINK_CREATE), &H5Pclose);
    H5Pset_create_intermediate_group(links, 1);
    const Id space(H5Screate_simple(1, &count, nullptr), &H5Sclose);
    const Id set(H5Dcreate2(file, name.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT),
                 &H5Dclose);
    require(set.ok(), name);
    require(count == 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0, name);
  }

  void set(const std::string& object, const std::string& name, hid_t type,
           const void* value) const {
    const Id owner(H5Oopen(file, object.c_str(), H5P_DEFAULT), &H5Oclose);
    const Id space(H5Screate(H5S_SCALAR), &H5Sclose);
    const Id attribute(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                       &H5Aclose);
    require(attribute.ok() && H5Awrite(attribute, type, value) >= 0, object + ": " + name);
  }
};

PlainH5::PlainH5(const std::filesystem::path& path) : impl_(std::make_unique<Impl>()) {
  silence_library();
  impl_->path = path;
  const std::filesystem::path part = path.string() + ".part";
  impl_->lock = PartLock(part);
  impl_->part = part;
  impl_->unfinished = PartName(part);
  impl_->file = H5Fcreate(part.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, unlocked_access());
  if (impl_->file < 0)
    throw FileError(
        fmt::format("{}: cannot be written (folder missing or disk full?)", path.string()));
}

PlainH5::~PlainH5() = default;

void PlainH5::group(const std::string& name) {
  const Id links(H5Pcreate(H5P_LINK_CREATE), &H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  const Id made(H5Gcreate2(impl_->file, name.c_str(), links, H5P_DEFAULT, H5P_DEFAULT), &H5Gclose);
  impl_->require(made.ok(), name);
}

void PlainH5::write(const std::string& name, const std::vector<double>& values) {
  impl_->write(name, H5T_NATIVE_DOUBLE, values.size(), values.data());
}

void PlainH5::write(const std::string& name, const std::vector<int32_t>& values) {
  impl_->write(name, H5T_NATIVE_INT32, values.size(), values.data());
}

void PlainH5::write_fixed(const std::string& name, const std::vector<std::string>& texts,
                          size_t length) {
  std::string bytes;
  for (const std::string& text : texts) {
    bytes += text.substr(0, length);
    bytes.append(length - std::min(length, text.size()), '\0');
  }
  const hsize_t extent = length;
  const Id type(H5Tarray_create2(H5T_STD_I8LE, 1, &extent), &H5Tclose);
  impl_->write(name, type, texts.size(), bytes.data());
}

void PlainH5::set(const std::string& object, const std::string& name, int32_t value) {
  impl_->set(object, name, H5T_NATIVE_INT32, &value);
}

void PlainH5::set(const std::string& object, const std::string& name, double value) {
  impl_->set(object, name, H5T_NATIVE_DOUBLE, &value);
}

void PlainH5::set(const std::string& object, const std::string& name, const std::string& text) {
  const Id type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type, text.size() + 1);
  impl_->set(object, name, type, text.c_str());
}

void PlainH5::commit() {
  const bool flushed = H5Fflush(impl_->file, H5F_SCOPE_GLOBAL) >= 0;
  const bool closed = H5Fclose(std::exchange(impl_->file, -1)) >= 0;
  const int descriptor = ::open(impl_->part.c_str(), O_RDWR | O_CLOEXEC);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  if (descriptor >= 0) ::close(descriptor);
  impl_->require(flushed && closed && synced, "file");
  std::error_code trouble;
  std::filesystem::rename(impl_->part, impl_->path, trouble);
  impl_->require(!trouble, "file");
  impl_->part.clear();
}

}  // namespace clatter
