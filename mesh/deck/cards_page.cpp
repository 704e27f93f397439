// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/cards_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "mesh/deck/abaqus/cards.hpp"
#include "mesh/deck/abaqus/read_cells.hpp"
#include "mesh/deck/nastran/cards.hpp"
#include "mesh/deck/nastran/control.hpp"

namespace clatter::mesh::deck {
namespace {

constexpr std::array<std::pair<Fate, const char*>, 3> kFates = {
    {{Fate::kRead, "read"}, {Fate::kPassed, "passed over"}, {Fate::kRefused, "refused"}}};

// Names of one fate and remark share a row.
void add_table(const char* title, const char* what, const std::vector<Listed>& listed,
               std::vector<std::string>& lines) {
  lines.insert(lines.end(),
               {"", fmt::format("## {}", title), "",
                fmt::format("| {} | | what it becomes or is, or why |", what), "|---|---|---|"});
  for (const auto& [fate, word] : kFates) {
    std::map<std::string, std::vector<std::string>> names_of;
    for (const Listed& one : listed)
      if (one.fate == fate) names_of[one.remark].push_back(fmt::format("`{}`", one.name));
    std::map<std::string, std::string> remark_of;
    for (auto& [remark, names] : names_of) {
      std::sort(names.begin(), names.end());
      remark_of[fmt::format("{}", fmt::join(names, " "))] = remark;
    }
    for (const auto& [names, remark] : remark_of)
      lines.push_back(fmt::format("| {} | {} | {} |", names, word, remark));
  }
}

}  // namespace

std::vector<std::string> cards_page() {
  std::vector<std::string> lines = {
      "# Cards and keywords of decks",
      "",
      "`clatter-mesh cards` writes this page from the tables of the readers. What is not in it is",
      "refused by name, with file and line; `--ignore NAME` skips it.",
      "`clatter-mesh part.bdf --check` lists all that one deck holds.",
      "[mesh/deck](../mesh/deck/README.md) has the choices and limits."};
  add_table("Nastran: cards of bulk data", "card", nastran::listed_cards(), lines);
  add_table("Nastran: executive and case control", "command", nastran::listed_commands(), lines);
  add_table("Abaqus and CalculiX: keywords", "keyword", abaqus::listed_keywords(), lines);
  add_table("Abaqus and CalculiX: element types", "type", abaqus::listed_elements(), lines);
  return lines;
}

}  // namespace clatter::mesh::deck
