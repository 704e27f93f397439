// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesh/deck/nastran/cards.hpp"
#include "mesh/deck/nastran/lines.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

class Parser : public CardSink {
 public:
  Parser(const Source& source, RawDeck& raw, Ignore& ignore, Refusals& refusals)
      : source_(source), ignore_(ignore), refusals_(refusals) {
    sections_.push_back({"BEGIN BULK", 0, std::move(raw), 0, ignore.lists("BEGIN BULK")});
  }

  /// False when a card was refused, so that others may have missing references.
  bool complete() const { return complete_; }

  size_t begin(std::string_view name, Origin origin) override {
    if (section().left_out) return 0;
    Content& content = refusals_.contents().count("card", name, source_, origin);
    if (role_ && role_->name == name) return role_->most_fields;
    role_ = nullptr;
    const Role* role = role_of(name);
    // Two-dimensional cells on faces of solids are kept as surfaces: build_skins() counts others.
    const bool skin = role && role->read == read_skin;
    const bool ignored = skin ? ignore_.lists(name) : ignore_.skips(name);
    content.fate = ignored ? Fate::kIgnored : role ? role->fate : Fate::kRefused;
    if (role) content.meaning = role->meaning;
    if (content.fate == Fate::kRead || content.fate == Fate::kPassed) {
      role_ = role;
      return role->most_fields;
    }
    if (!ignored) refused_.try_emplace(std::string(name), Refused{origin, &content});
    if (!role && !ignored) check_word(name, origin);
    return 0;
  }

  void card(const Card& card) override {
    ++section().cards;
    if (section().left_out) return;
    const bool current = role_ && role_->name == card.name();
    const Role* role = current ? role_ : role_of(card.name());
    if (!current && ignore_.lists(card.name())) return ignored(card, role);
    if (unreadable_.contains(card.name())) return;
    if (refused_.contains(card.name()) || role->fate == Fate::kPassed) return;
    complete_ = refusals_.attempt([&] { read(card, *role); }) && complete_;
  }

  void comment(std::string_view line, Origin origin) override {
    constexpr std::string_view kOurs = "$ clatter ";
    if (line.starts_with(kOurs) && !section().left_out) {
      read_comment(line.substr(kOurs.size()), origin, source_, raw());
    }
  }

  void begin_section(std::string_view line, Origin origin) override {
    role_ = nullptr;
    const std::string name = capitals(line);
    RawDeck fresh;
    fresh.control = raw().control;
    const bool ignored = ignore_.skips(name);
    refusals_.contents().count("section", name, source_, origin).fate =
        ignored ? Fate::kIgnored : Fate::kRead;
    sections_.push_back({name, origin, std::move(fresh), 0, ignored});
  }

  /// One refusal for each kind of card that is not supported, with how many there are.
  void refuse_cards() {
    std::vector<std::pair<std::string, Refused>> all(refused_.begin(), refused_.end());
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return a.second.origin < b.second.origin; });
    for (const auto& [name, refused] : all)
      refusals_.attempt([&, &name = name, &refused = refused] { refuse(name, refused); });
  }

  /// The section with solids; InputError when several have some.
  RawDeck choose() {
    const auto has_cells = [](const Section& s) { return !s.left_out && !s.raw.blocks.empty(); };
    auto chosen = std::find_if(sections_.begin(), sections_.end(), has_cells);
    if (chosen == sections_.end())
      chosen = std::find_if(sections_.begin(), sections_.end(),
                            [](const Section& s) { return !s.left_out && !s.raw.skins.empty(); });
    if (chosen == sections_.end())
      chosen = std::find_if(sections_.begin(), sections_.end(),
                            [](const Section& s) { return !s.left_out; });
    if (chosen == sections_.end())
      throw InputError(fmt::format("{}: found no section of bulk data that is not ignored",
                                   source_.files().front()));
    if (const auto other = std::find_if(chosen + 1, sections_.end(), has_cells);
        other != sections_.end())
      source_.fail(other->origin,
                   fmt::format("found solids here and in {}, expected one part; ignore = "
                               "[\"{}\"] reads the first, ignore = [\"{}\"] the second",
                               chosen->name, other->name, chosen->name));
    RawDeck raw = std::move(chosen->raw);
    for (Section& one : sections_)
      if (&one != &*chosen) drop_choices(raw, one.raw, one.name);
    for (const Section& one : sections_)
      if (&one != &*chosen && one.cards > 0)
        raw.notes.push_back(fmt::format(
            "{}: {} has no solids: its {} cards ({} masses, {} springs, {} couplings) are left out",
            source_.where(one.origin), one.name, one.cards, one.raw.masses.size(),
            one.raw.springs.size() + one.raw.bushes.size(),
            one.raw.rigid.size() + one.raw.distributing.size()));
    return raw;
  }

 private:
  /// BEGIN BULK, or the bulk data of a superelement.
  struct Section {
    std::string name;
    Origin origin;
    RawDeck raw;
    int64_t cards;
    bool left_out;  // by the user
  };
  /// Case control is for all sections: sets that only `other` has select nothing of this one, but
  /// its requests of modes do.
  void drop_choices(RawDeck& raw, RawDeck& other, const std::string& name) const {
    raw.eigen_counts.merge(other.eigen_counts);
    struct Kind {
      const char* command;
      int32_t Choice::*set;
      bool (*has)(const RawDeck&, int32_t);
    };
    constexpr std::array<Kind, 4> kKinds = {
        {{"SPC", &Choice::spc,
          [](const RawDeck& one, int32_t set) {
            return one.spc.contains(set) || one.spc_sums.contains(set);
          }},
         {"MPC", &Choice::mpc,
          [](const RawDeck& one, int32_t set) {
            return one.mpc.contains(set) || one.mpc_sums.contains(set);
          }},
         {"LOAD", &Choice::load,
          [](const RawDeck& one, int32_t set) {
            return one.loads.contains(set) || one.load_sums.contains(set);
          }},
         {"TEMPERATURE", &Choice::temperature,
          [](const RawDeck& one, int32_t set) { return one.temperatures.contains(set); }}}};
    std::set<std::pair<std::string, int32_t>> said;
    for (Subcase& subcase : raw.control.subcases)
      for (const Kind& kind : kKinds) {
        int32_t& set = subcase.choice.*kind.set;
        if (set == 0 || kind.has(raw, set) || !kind.has(other, set)) continue;
        if (said.emplace(kind.command, set).second)
          raw.notes.push_back(fmt::format("{}: {} = {} is a set of {}: left out",
                                          source_.files().front(), kind.command, set, name));
        set = 0;
      }
  }

  struct Refused {
    Origin origin;
    const Content* content;
  };

  Section& section() { return sections_.back(); }
  RawDeck& raw() { return sections_.back().raw; }

  void read(const Card& card, const Role& role) {
    if (role.name == "PARAM") parameter(card);
    if (!role.read) return;
    if (role.most_fields > 0) card.at_most(role.most_fields);
    role.read(card, raw());
  }

  void parameter(const Card& card) {
    Content& content =
        refusals_.contents().count("parameter", card.text(0), source_, card.origin());
    const bool used =
        read_parameter(raw().control, card.text(0), card.text(1), source_, card.origin());
    content.fate = used ? Fate::kRead : Fate::kPassed;
  }

  // Of ignored cells the grids are needed: what hangs on them hangs on nothing.
  void ignored(const Card& card, const Role* role) {
    if (!role) return;
    if (role->read == read_skin) return read_skin(card, raw());
    for (size_t i = 0; i < role->grids; ++i) {
      const auto grid = to_integer(card.text(role->first_grid + i));
      if (grid && *grid > 0) raw().lost_grids.push_back(*grid);
    }
  }

  void check_word(std::string_view name, Origin origin) {
    const bool word = name.size() <= 16 && std::all_of(name.begin(), name.end(), [](char c) {
                        return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
                      });
    if (word) return;
    refused_.erase(std::string(name));
    unreadable_.emplace(name);
    complete_ = false;
    refusals_.attempt([&] {
      source_.fail(origin, fmt::format("found {}, expected a card of bulk data", shown(name)));
    });
  }

  [[noreturn]] void refuse(const std::string& name, const Refused& refused) {
    const Role* role = role_of(name);
    const int64_t count = refused.content->count;
    const std::string times = count > 1 ? fmt::format(" ({} times)", count) : "";
    const std::string advice =
        role
            ? ": " + advice_of(*role)
            : fmt::format("; ignore = [\"{}\"] skips it, with all that it adds to the model", name);
    source_.fail(refused.origin, fmt::format("card {}{} is not supported{}", name, times, advice));
  }

  const Source& source_;
  Ignore& ignore_;
  Refusals& refusals_;
  std::vector<Section> sections_;
  bool complete_ = true;
  std::map<std::string, Refused, std::less<>> refused_;  // unsupported cards by name
  std::set<std::string, std::less<>> unreadable_;        // names that are no words
  const Role* role_ = nullptr;  // of the current card; null when it is not read
};

}  // namespace

RawDeck parse(Source& source, Ignore& ignore, Refusals& refusals) {
  RawDeck raw;
  raw.control = read_control(source, ignore, refusals);
  Parser sink(source, raw, ignore, refusals);
  const CardsEnd end = read_cards(source, sink, refusals);
  sink.refuse_cards();
  if (!end.complete || !sink.complete()) refusals.raise();
  refusals.require([&] { raw = sink.choose(); });
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
