// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/part_names.hpp"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace clatter {
namespace {

// A program writes only a few files at a time; if the table is full, a part file may remain after a
// signal.
std::array<std::atomic<char*>, 32> names;

// Calls only async-signal-safe functions.
void remove_and_end(int signal) {
  for (std::atomic<char*>& name : names)
    if (const char* path = name.load()) ::unlink(path);
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

}  // namespace

PartName::PartName(const std::filesystem::path& path) {
  char* name = ::strdup(path.c_str());
  for (size_t i = 0; i < names.size(); ++i) {
    char* empty = nullptr;
    if (!names[i].compare_exchange_strong(empty, name)) continue;
    slot_ = static_cast<int>(i);
    return;
  }
  std::free(name);
}

PartName::PartName(PartName&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {}

PartName& PartName::operator=(PartName&& other) noexcept {
  std::swap(slot_, other.slot_);
  return *this;
}

PartName::~PartName() {
  if (slot_ >= 0) std::free(names[slot_].exchange(nullptr));
}

void remove_parts_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    struct sigaction old = {};
    ::sigaction(signal, nullptr, &old);
    if (old.sa_handler == SIG_DFL) ::signal(signal, remove_and_end);
  }
}

}  // namespace clatter
