// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Segmentation faults on purpose.
#include <csignal>

namespace clatter::test {

/// While it exists a segmentation fault ends this process and its children by the signal, also
/// under the address sanitizer, which would report it and exit.
class PlainFaults {
 public:
  PlainFaults() : before_(std::signal(SIGSEGV, SIG_DFL)) {}
  ~PlainFaults() { std::signal(SIGSEGV, before_); }
  PlainFaults(const PlainFaults&) = delete;
  PlainFaults& operator=(const PlainFaults&) = delete;

 private:
  void (*before_)(int);
};

}  // namespace clatter::test
