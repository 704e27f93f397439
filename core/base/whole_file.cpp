// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <iterator>
#include <map>
#include <mutex>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/part_lock.hpp"

namespace clatter {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw FileError(
      fmt::format("{}: cannot be written (folder missing or disk full?)", path.string()));
}

bool synced(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool good = ::fsync(file) == 0;
  return ::close(file) == 0 && good;
}

// By their names; the lock of a part lives until its WholeFile ends.
std::mutex guard;
std::map<std::filesystem::path, PartLock> locks;

std::filesystem::path locked(const std::filesystem::path& part) {
  PartLock lock(part);
  const std::lock_guard<std::mutex> alone(guard);
  locks.insert_or_assign(part, std::move(lock));
  return part;
}

void unlock(const std::filesystem::path& part) {
  const std::lock_guard<std::mutex> alone(guard);
  locks.erase(part);
}

}  // namespace

WholeFile::WholeFile(const std::filesystem::path& path)
    : path_(path),
      part_(locked(path.string() + ".part")),
      unfinished_(part_),
      stream_(part_, std::ios::binary) {
  if (!stream_) fail(path_);
}

WholeFile::~WholeFile() {
  if (part_.empty()) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  unlock(part_);
}

void WholeFile::commit() {
  stream_.close();
  if (!stream_ || !synced(part_)) fail(path_);
  std::error_code trouble;
  std::filesystem::rename(part_, path_, trouble);
  if (trouble) throw FileError(fmt::format("{}: {}", path_.string(), trouble.message()));
  unlock(part_);
  part_.clear();
}

std::string read_whole_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw FileError(fmt::format("{}: cannot be read", path.string()));
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_whole_file(const std::filesystem::path& path, std::string_view text) {
  WholeFile file(path);
  file.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
  file.commit();
}

}  // namespace clatter
