// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "core/base/log.hpp"

namespace clatter {
namespace {

constexpr double kFirstShown = 2.0;       // seconds without output at the start
constexpr double kTerminalPeriod = 0.25;  // seconds between redraws of the bar
constexpr double kLinePeriod = 10.0;      // seconds between plain lines
constexpr int kBarWidth = 24;

// Under `make -j` several programs share the terminal: bars would overwrite each other.
bool beside_others() {
  const char* flags = std::getenv("MAKEFLAGS");
  return flags != nullptr && std::string_view(flags).find("--jobserver") != std::string_view::npos;
}

}  // namespace

Progress::Progress(std::string label, double total, std::string unit)
    : label_(std::move(label)),
      unit_(std::move(unit)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) != 0 && !beside_others()) {}

Progress::~Progress() {
  if (shown_ && terminal_) std::fputc('\n', stderr);
}

void Progress::update(double done) {
  if (is_quiet() || total_ <= 0.0) return;
  const double now = clock_.seconds();
  const double period = terminal_ ? kTerminalPeriod : kLinePeriod;
  if (now < kFirstShown || (shown_ && now - shown_at_ < period)) return;
  shown_at_ = now;
  shown_ = true;
  const double part = std::clamp(done / total_, 0.0, 1.0);
  const double left = part > 0.0 ? now * (1.0 - part) / part : 0.0;
  const std::string text = fmt::format("{:5.1f} %  {:.4g}/{:.4g}{}{}  {:.0f} s left", 100.0 * part,
                                       done, total_, unit_.empty() ? "" : " ", unit_, left);
  if (terminal_) {
    const std::string bar(static_cast<size_t>(part * kBarWidth), '#');
    std::fprintf(stderr, "\r  %-24s [%-*s] %s   ", label_.c_str(), kBarWidth, bar.c_str(),
                 text.c_str());
    std::fflush(stderr);
  } else {
    say(fmt::format("  {}: {}", label_, text));
  }
}

}  // namespace clatter
