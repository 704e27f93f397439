// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/standard_streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "core/base/error.hpp"

namespace clatter {

void secure_standard_streams() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(number, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free number, which is this one: those below it are open.
    [[maybe_unused]] const int opened =
        ::open("/dev/null", number == STDIN_FILENO ? O_RDONLY : O_WRONLY);
  }
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
}

void finish_standard_output() {
  const bool earlier = std::ferror(stdout) != 0;
  const bool flushed = std::fflush(stdout) == 0;
  const int why = errno;
  if ((flushed && !earlier) || (!flushed && why == EPIPE)) return;
  std::clearerr(stdout);
  throw FileError(fmt::format("standard output: cannot be written: {}",
                              flushed ? "an earlier line was lost" : std::strerror(why)));
}

}  // namespace clatter
