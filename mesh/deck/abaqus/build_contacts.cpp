// SPDX-License-Identifier: GPL-3.0-or-later
// Contact that is bonded is a tie; any other has no stiffness of its own in a linear model.
#include <fmt/format.h>

#include <map>
#include <set>

#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

class Contacts {
 public:
  explicit Contacts(Model& model) : model_(model) {}

  void run() {
    read_interactions();
    for_each_card(model_, {"CONTACTPAIR"},
                  [&](size_t use, const Card& card) { read_pair(use, card); });
    read_general();
  }

 private:
  struct Interaction {
    bool tied = false;           // PRESSURE-OVERCLOSURE=TIED, *COHESIVE BEHAVIOR
    bool no_separation = false;  // with ROUGH it is bonded
    bool rough = false;

    bool bonded() const { return tied || (no_separation && rough); }
  };

  void read_interactions() {
    Interaction* open = nullptr;
    for_each_card(model_, {"SURFACEINTERACTION", "SURFACEBEHAVIOR", "FRICTION", "COHESIVEBEHAVIOR"},
                  [&](size_t, const Card& card) {
                    const Keyword& keyword = card.keyword();
                    if (keyword.key == "SURFACEINTERACTION") {
                      open = &interactions_[folded(keyword.required("NAME", model_.source))];
                    } else if (open != nullptr && keyword.key == "SURFACEBEHAVIOR") {
                      open->tied |= keyword.choice("PRESSURE-OVERCLOSURE", "") == "TIED";
                      open->no_separation |= keyword.has("NOSEPARATION");
                    } else if (open != nullptr && keyword.key == "FRICTION") {
                      open->rough |= keyword.has("ROUGH");
                    } else if (open != nullptr) {
                      open->tied = true;
                    }
                  });
  }

  bool is_bonded(const std::string& interaction) const {
    const auto known = interactions_.find(folded(interaction));
    return known != interactions_.end() && known->second.bonded();
  }

  void read_pair(size_t use, const Card& card) {
    const Keyword& keyword = card.keyword();
    const std::string interaction = keyword.choice("INTERACTION", "");
    if (!keyword.has("TIED") && !is_bonded(interaction)) refuse_open(card.origin(), interaction);
    double distance = -1.0;
    for (const char* name : {"ADJUST", "POSITIONTOLERANCE"}) {
      const std::string* text = keyword.find(name);
      if (text == nullptr) continue;
      if (const auto number = to_number(*text)) distance = *number;
    }
    for (size_t i = 0; i < card.size(); ++i) {
      const Fields fields = card.line(i, model_.source);
      fields.at_most(4, "slave, master, their directions");
      add(use, fields.word(0, "slave surface"), fields.word(1, "master surface"), fields.origin(),
          distance);
    }
  }

  void add(size_t use, const std::string& slave, const std::string& master, Origin origin,
           double distance) {
    Tie tie;
    tie.name = fmt::format("bonded_{}_{}", slave, master);
    tie.where = model_.source.where(origin);
    tie.slave = surface_named(model_, use, slave, origin);
    tie.master = surface_named(model_, use, master, origin);
    tie.distance = distance;
    model_.deck.ties.push_back(std::move(tie));
  }

  [[noreturn]] void refuse_open(Origin origin, const std::string& interaction) const {
    model_.source.fail(
        origin,
        fmt::format("contact{} opens and slides, which is not linear; expected TIED, *SURFACE "
                    "BEHAVIOR, PRESSURE-OVERCLOSURE=TIED, or NO SEPARATION with *FRICTION, "
                    "ROUGH; ignore = [\"*CONTACT PAIR\", \"*CONTACT\"] leaves the surfaces "
                    "apart, and [[tie]] of the recipe bonds them",
                    interaction.empty() ? "" : " with " + interaction));
  }

  // *CONTACT: pairs of *CONTACT INCLUSIONS or of bonded *CONTACT PROPERTY ASSIGNMENT, without those
  // of *CONTACT EXCLUSIONS. The last assignment of a pair counts.
  void read_general() {
    using Pair = std::pair<std::string, std::string>;
    std::map<Pair, std::pair<bool, Origin>> bonded;
    std::set<Pair> excluded;
    Origin open = -1;
    std::string of;
    size_t in_use = 0;
    bool any = false;
    for_each_card(model_, {"CONTACTINCLUSIONS", "CONTACTEXCLUSIONS", "CONTACTPROPERTYASSIGNMENT"},
                  [&](size_t use, const Card& card) {
                    any = true;
                    in_use = use;
                    if (card.keyword().has("ALLEXTERIOR")) open = card.origin();
                    for (size_t i = 0; i < card.size(); ++i) {
                      const Fields fields = card.line(i, model_.source);
                      const Pair pair(fields.text(0), fields.text(1));
                      if (card.keyword().key == "CONTACTEXCLUSIONS") {
                        excluded.insert(pair);
                        continue;
                      }
                      if (card.keyword().key == "CONTACTINCLUSIONS") {
                        bonded.try_emplace(pair, false, fields.origin());
                        continue;
                      }
                      const std::string interaction(fields.text(2));
                      const bool is = is_bonded(interaction);
                      if (pair.first.empty() || pair.second.empty()) {
                        open = fields.origin(), of = interaction;
                        if (is) {
                          fields.fail(
                              "found a bonded contact of all surfaces, expected the names of both "
                              "surfaces of each pair");
                        }
                        continue;
                      }
                      bonded[pair] = {is, fields.origin()};
                    }
                  });
    if (!any || model_.ignore.lists("CONTACT")) return;
    bool found = false;
    for (const auto& [pair, state] : bonded) {
      if (excluded.contains(pair)) continue;
      if (!state.first) refuse_open(state.second, "");
      add(in_use, pair.first, pair.second, state.second, -1.0);
      found = true;
    }
    if (open < 0) return;
    const std::string line = model_.source.where(open);
    if (!found) refuse_open(open, of);
    model_.deck.notes.push_back(fmt::format(
        "{}: general contact of all other surfaces opens and slides: left out, only its {} bonded "
        "pairs are tied",
        line, bonded.size()));
  }

  Model& model_;
  std::map<std::string, Interaction> interactions_;
};

}  // namespace

void build_contacts(Model& model) {
  model.refusals.attempt([&] { Contacts(model).run(); });
}

}  // namespace clatter::mesh::deck::abaqus
