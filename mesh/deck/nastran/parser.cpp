// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "mesh/deck/nastran/cards.hpp"
#include "mesh/deck/nastran/lines.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

class Parser : public CardSink {
 public:
  Parser(const Source& source, RawDeck& raw, Ignore& ignore, Refusals& refusals)
      : source_(source), raw_(raw), ignore_(ignore), refusals_(refusals) {}

  /// False when a card was refused, so that others may have missing references.
  bool complete() const { return complete_; }

  size_t begin(std::string_view name, Origin origin) override {
    Content& content = refusals_.contents().count("card", name, source_, origin);
    if (role_ && role_->name == name) return role_->most_fields;
    role_ = nullptr;
    content.fate = Fate::kIgnored;
    if (ignore_.skips(name)) return 0;
    role_ = role_of(name);
    if (role_) {
      content.fate = role_->fate();
      content.meaning = role_->meaning;
      return role_->most_fields;
    }
    content.fate = Fate::kRefused;
    refused_.emplace(name);
    refusals_.attempt([&] { refuse(name, origin); });
    return 0;
  }

  void card(const Card& card) override {
    const bool current = role_ && role_->name == card.name();
    if (!current && (ignore_.lists(card.name()) || refused_.contains(card.name()))) return;
    complete_ = refusals_.attempt([&] { read(card, current); }) && complete_;
  }

  void comment(std::string_view line, Origin origin) override {
    constexpr std::string_view kOurs = "$ clatter ";
    if (line.starts_with(kOurs)) {
      read_comment(line.substr(kOurs.size()), origin, source_, raw_);
    }
  }

 private:
  void read(const Card& card, bool current) {
    const Role& role = current ? *role_ : *role_of(card.name());
    if (role.name == "PARAM") parameter(card);
    if (!role.read) return;
    if (role.most_fields > 0) card.at_most(role.most_fields);
    role.read(card, raw_);
  }

  void parameter(const Card& card) {
    Content& content =
        refusals_.contents().count("parameter", card.text(0), source_, card.origin());
    const bool used =
        read_parameter(raw_.control, card.text(0), card.text(1), source_, card.origin());
    content.fate = used ? Fate::kRead : Fate::kPassed;
  }

  [[noreturn]] void refuse(std::string_view name, Origin origin) {
    const bool word = name.size() <= 16 && std::all_of(name.begin(), name.end(), [](char c) {
                        return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
                      });
    if (!word) {
      complete_ = false;
      source_.fail(origin, fmt::format("found {}, expected a card of bulk data", shown(name)));
    }
    const std::string_view why = why_refused(name);
    source_.fail(origin, fmt::format("card {0} is not supported{1}; ignore = [\"{0}\"] skips it",
                                     name, why.empty() ? "" : fmt::format(" ({})", why)));
  }

  const Source& source_;
  RawDeck& raw_;
  Ignore& ignore_;
  Refusals& refusals_;
  bool complete_ = true;
  std::set<std::string, std::less<>> refused_;  // names of unsupported cards
  const Role* role_ = nullptr;                  // of the current card; null when it is ignored
};

}  // namespace

RawDeck parse(Source& source, Ignore& ignore, Refusals& refusals) {
  RawDeck raw;
  raw.control = read_control(source, ignore, refusals);
  Parser sink(source, raw, ignore, refusals);
  const CardsEnd end = read_cards(source, sink, refusals);
  if (!end.complete || !sink.complete()) refusals.raise();
  if (!end.end_data && !end.last.empty()) {
    const std::string missing =
        end.missing_continuation.empty()
            ? ""
            : fmt::format(" whose continuation {} is missing", shown(end.missing_continuation));
    raw.notes.push_back(
        fmt::format("{}: the deck ends here, after card {}{}, without ENDDATA: "
                    "the file may be truncated",
                    source.where(source.origin()), end.last, missing));
  }
  return raw;
}

}  // namespace clatter::mesh::deck::nastran
