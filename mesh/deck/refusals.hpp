// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Collects the refusals of a deck, and what it holds.
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "mesh/deck/contents.hpp"

namespace clatter::mesh::deck {

/// A message and the positions ("deck.inp:12") at which it applies.
struct Refusal {
  std::string position, message;
  std::vector<std::string> again;  // other positions
};

/// All refusals of a deck in one message; ends the reading.
struct DeckRefused : InputError {
  DeckRefused(const std::string& text, std::vector<Refusal> all)
      : InputError(text), refusals(std::move(all)) {}
  std::vector<Refusal> refusals;
};

/// The deck cannot be read beyond this line (a line without end).
struct BrokenDeck : InputError {
  using InputError::InputError;
};

/// A consequence of an earlier refusal: not reported.
struct FollowUp : InputError {
  FollowUp() : InputError("follows from what was refused before") {}
};

/// Collects "deck.inp:12: message" while a reader continues with the next card. The same message at
/// other lines is counted, not repeated.
class Refusals {
 public:
  /// How many end the reading: of a run, and where the user wants to see all of them.
  static constexpr size_t kMost = 10, kMostOfAll = 1000;

  /// `contents`: where to record what the deck holds, and all refusals then; null: nowhere.
  explicit Refusals(Contents* contents = nullptr)
      : contents_(contents == nullptr ? own_ : *contents),
        most_(contents == nullptr ? kMost : kMostOfAll) {}
  Refusals(const Refusals&) = delete;
  Refusals& operator=(const Refusals&) = delete;

  Contents& contents() { return contents_; }

  /// Runs `body`; false when it threw an InputError, which is kept. Throws DeckRefused once there
  /// are too many.
  template <class Body>
  bool attempt(const Body& body) {
    try {
      body();
      return true;
    } catch (const DeckRefused&) {
      throw;
    } catch (const FollowUp&) {
    } catch (const BrokenDeck& error) {
      add(error.what());
      raise();
    } catch (const InputError& error) {
      add(error.what());
    }
    return false;
  }

  /// The same for a required step: DeckRefused when it fails.
  template <class Body>
  void require(const Body& body) {
    if (!attempt(body)) raise();
  }

  /// Keeps "position: message".
  void add(const std::string& text);
  size_t size() const { return found_.size(); }
  bool any() const { return !found_.empty(); }
  /// Throws DeckRefused with all refusals, one per line, if there are any.
  void raise() const;

  /// Records the folded name of a refused item that others may reference (a material, a surface).
  void lose(const std::string& name) { lost_.insert(name); }
  bool has_lost(const std::string& name) const { return lost_.contains(name); }

 private:
  Contents own_;
  Contents& contents_;
  size_t most_;
  std::vector<Refusal> found_;
  std::set<std::string> lost_;
};

}  // namespace clatter::mesh::deck
