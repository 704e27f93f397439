// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clatter::mesh::deck {

void Refusals::add(const std::string& text) {
  const size_t colon = std::min(text.find(": "), text.size());
  Refusal one{text.substr(0, colon), text.substr(colon), {}};
  const auto same = std::find_if(found_.begin(), found_.end(),
                                 [&](const Refusal& f) { return f.message == one.message; });
  if (same == found_.end()) {
    found_.push_back(std::move(one));
  } else if (same->position != one.position) {
    same->again.push_back(one.position);
  }
  if (found_.size() >= most_) raise();
}

void Refusals::raise() const {
  if (found_.empty()) return;
  std::string text = found_.size() == 1 ? "" : fmt::format("{} refusals:", found_.size());
  if (found_.size() >= most_) text = fmt::format("the first {} refusals:", most_);
  for (const Refusal& found : found_) {
    if (found_.size() > 1) text += "\n  ";
    text += found.position + found.message;
    if (!found.again.empty()) {
      text += fmt::format(" (and {} more, next at {})", found.again.size(), found.again.front());
    }
  }
  throw DeckRefused(text, found_);
}

}  // namespace clatter::mesh::deck
