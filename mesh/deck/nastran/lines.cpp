// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/lines.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "mesh/deck/nastran/replication.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

constexpr size_t kLongestFileName = 4096;

bool starts_with_word(std::string_view line, std::string_view word) {
  if (line.size() < word.size()) return false;
  for (size_t i = 0; i < word.size(); ++i) {
    if ((line[i] & ~0x20) != (word[i] & ~0x20)) return false;
  }
  return true;
}

class CardReader {
 public:
  CardReader(Source& source, CardSink& sink, Refusals& refusals)
      : source_(source), sink_(sink), refusals_(refusals), current_(source) {}

  CardsEnd run() {
    bool more = true;
    while (more) go_on([&] { more = read_line(); });
    if (!current_.empty()) end_.last = current_.name();
    const bool full = most_ > 0 && current_.size() >= most_;
    if (!current_.empty() && !orphan_ && !full && !orphans_.contains(current_.next())) {
      end_.missing_continuation = current_.next();
    }
    end_section();
    return end_;
  }

 private:
  // A refused card is dropped, the next ones are read.
  template <class Body>
  void go_on(const Body& body) {
    if (refusals_.attempt(body)) return;
    end_.complete = false;
    current_.clear();
  }

  void end_section() {
    go_on([&] { finish(); });
    go_on([&] { join_waiting(); });
    waiting_.clear();
    orphans_.clear();
  }

  // False after the last line.
  bool read_line() {
    const auto line = source_.next();
    if (!line) return false;
    std::string_view text = *line;
    if (!text.empty() && text[0] == '$') {
      sink_.comment(text, source_.origin());
      return true;
    }
    if (follow_include(source_, text)) return true;
    text = without_comment(text);
    if (text.empty()) return true;
    if (starts_with_word(text, "BEGIN ")) {
      end_section();
      sink_.begin_section(trimmed(text), source_.origin());
      return true;
    }
    end_.end_data = starts_with_word(text, "ENDDATA");
    if (!end_.end_data) take(text);
    return !end_.end_data;
  }

  void take(std::string_view line) {
    const Origin origin = source_.origin();
    const std::string trouble = split_line(line, fields_);
    if (!trouble.empty()) source_.fail(origin, trouble);
    if (Replication::is_replication(fields_)) {
      std::string wrong;
      const std::vector<std::string> lines = replication_.expand(fields_, wrong);
      if (!wrong.empty()) source_.fail(origin, wrong);
      for (const std::string& one : lines) take(one);
      return;
    }
    if (!fields_.continuation) {
      replication_.remember(line);
      finish();
      current_.start(fields_, origin);
      most_ = sink_.begin(current_.name(), origin);
      orphan_ = false;
      return;
    }
    const std::string name = capitals(fields_.head);
    if (name.empty() || (!current_.empty() && name == current_.next())) {
      if (current_.empty() && !end_.complete) throw FollowUp();
      if (current_.empty()) {
        source_.fail(origin, "found a continuation line, expected a card before it");
      }
      const std::string refusal = current_.append(fields_, origin);
      if (!refusal.empty()) source_.fail(origin, refusal);
      return;
    }
    finish();
    current_.start(fields_, origin);
    orphan_ = true;
  }

  // Passes the current card on, or stores it or the continuation.
  void finish() {
    if (current_.empty()) return;
    if (orphan_) {
      const std::string name(current_.name());
      if (!orphans_.emplace(name, current_).second) {
        source_.fail(current_.origin(),
                     fmt::format("found a second continuation named {}, expected "
                                 "one, or each after its own card",
                                 shown(name)));
      }
    } else if (current_.next().empty() || (most_ > 0 && current_.size() >= most_)) {
      sink_.card(current_);
    } else {
      waiting_.push_back(current_);
    }
    current_.clear();
  }

  void join_waiting() {
    if (!orphans_.empty()) refuse_ambiguous();
    for (Card& card : waiting_) {
      for (auto at = orphans_.find(card.next()); at != orphans_.end();
           at = orphans_.find(card.next())) {
        const std::string refusal = card.append(at->second);
        if (!refusal.empty()) source_.fail(at->second.origin(), refusal);
        orphans_.erase(at);
      }
      sink_.card(card);
      card = Card(source_);  // frees its memory
    }
    for (const auto& [name, continuation] : orphans_) {
      source_.fail(continuation.origin(),
                   fmt::format("found continuation {}, expected a card that ends in this name",
                               shown(name)));
    }
  }

  // A continuation required by two cards.
  void refuse_ambiguous() {
    std::map<std::string_view, Origin> requested;
    for (const Card& card : waiting_) {
      const auto orphan = orphans_.find(card.next());
      if (orphan == orphans_.end()) continue;
      const auto [first, fresh] = requested.emplace(card.next(), card.origin());
      if (fresh) continue;
      source_.fail(orphan->second.origin(),
                   fmt::format("continuation {} belongs to one card, found two that require it: {} "
                               "and {}",
                               shown(card.next()), source_.where(first->second),
                               source_.where(card.origin())));
    }
  }

  Source& source_;
  CardSink& sink_;
  Refusals& refusals_;
  CardsEnd end_;
  LineFields fields_;
  Replication replication_;
  Card current_;
  size_t most_ = 0;
  bool orphan_ = false;
  std::vector<Card> waiting_;
  std::map<std::string, Card, std::less<>> orphans_;
};

}  // namespace

CardsEnd read_cards(Source& source, CardSink& sink, Refusals& refusals) {
  return CardReader(source, sink, refusals).run();
}

bool follow_include(Source& source, std::string_view line) {
  line = trimmed(line);
  if (!starts_with_word(line, "INCLUDE")) return false;
  line.remove_prefix(7);
  if (!line.empty() && line[0] != ' ' && line[0] != '\t' && line[0] != '\'' && line[0] != '"' &&
      line[0] != '=') {
    return false;
  }
  const Origin origin = source.origin();
  line = trimmed(line);
  if (line.starts_with('=')) line = trimmed(line.substr(1));
  std::string name;
  if (line.empty() || (line[0] != '\'' && line[0] != '"')) {
    name = without_comment(line);
  } else {
    const char quote = line[0];
    line.remove_prefix(1);
    for (;;) {
      const size_t end = line.find(quote);
      name += trimmed(line.substr(0, end));
      if (end != std::string_view::npos) break;
      const auto more = name.size() <= kLongestFileName ? source.next() : std::nullopt;
      if (!more) source.fail(origin, "INCLUDE: found no quote at the end of the file name");
      line = *more;
    }
  }
  if (name.empty() || name.size() > kLongestFileName) {
    source.fail(origin, "INCLUDE: expected the name of a file");
  }
  source.include(name, source.origin());
  return true;
}

}  // namespace clatter::mesh::deck::nastran
