#pragma once
// Refusals of a deck, kept until up to ten have come together.
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"

namespace clatter::mesh::deck {

/// All refusals of a deck in one message; nothing more is read after it.
struct DeckRefused : InputError {
  using InputError::InputError;
};

/// The deck cannot be read on behind this place (a line without end).
struct BrokenDeck : InputError {
  using InputError::InputError;
};

/// What came only of an earlier refusal: not worth a line of its own.
struct FollowUp : InputError {
  FollowUp() : InputError("follows from what was refused before") {}
};

/// Collects "deck.inp:12: message" while a reader goes on with the next card. The same message at
/// other places is counted, not repeated.
class Refusals {
 public:
  static constexpr size_t kMost = 10;

  /// Runs `body`; false when it ended in an InputError, which is kept. Throws DeckRefused once
  /// kMost have come.
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

  /// The same for what all that follows needs: DeckRefused when it fails.
  template <class Body>
  void require(const Body& body) {
    if (!attempt(body)) raise();
  }

  /// Keeps "place: message".
  void add(const std::string& text);
  size_t size() const { return found_.size(); }
  bool any() const { return !found_.empty(); }
  /// DeckRefused with all refusals, one a line; nothing when there is none.
  void raise() const;

  /// Remembers by its folded name what was refused where others name it (a material, a surface).
  void lose(const std::string& name) { lost_.insert(name); }
  bool has_lost(const std::string& name) const { return lost_.contains(name); }

 private:
  struct Found {
    std::string position, message;
    std::vector<std::string> again;  // other places of the same message
  };
  std::vector<Found> found_;
  std::set<std::string> lost_;
};

}  // namespace clatter::mesh::deck
