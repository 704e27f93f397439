// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "mesh/deck/contents.hpp"
#include "mesh/deck/import.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck {
namespace {

const char* name_of(Fate fate) {
  switch (fate) {
    case Fate::kRead:
      return "read";
    case Fate::kPassed:
      return "passed over";
    case Fate::kIgnored:
      return "ignored";
    case Fate::kRefused:
      return "refused";
  }
  return "";
}

// "deck.bdf:12" and the text after it; no position where the message is about the entire deck.
std::pair<std::string, std::string> divided(const std::string& message) {
  const size_t colon = message.find(": ");
  const bool at_line = colon != std::string::npos && colon > 0 &&
                       std::isdigit(static_cast<unsigned char>(message[colon - 1])) != 0;
  if (!at_line) return {"", message};
  return {message.substr(0, colon), message.substr(colon + 2)};
}

std::vector<CheckedRow> rows_of(const Contents& contents) {
  std::vector<CheckedRow> rows;
  for (const Content& one : contents.rows())
    rows.push_back(
        {one.count, one.kind, one.name, name_of(one.fate), one.first, std::string(one.meaning)});
  return rows;
}

// A refusal of all cards of a name completes their row; any other has a row of its own.
void add_refusal(const Refusal& refusal, std::vector<CheckedRow>& rows) {
  const std::string text = refusal.message.substr(std::min<size_t>(2, refusal.message.size()));
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const CheckedRow& one) {
    return one.fate == "refused" && !one.name.empty() && one.where == refusal.position;
  });
  if (row != rows.end()) {
    row->remark = text;
    return;
  }
  std::string again;
  if (!refusal.again.empty()) again = fmt::format(" (next at {})", refusal.again.front());
  rows.push_back({1 + static_cast<int64_t>(refusal.again.size()), "", "", "refused",
                  refusal.position, text + again});
}

int64_t shells_in(const Mesh& mesh) {
  int64_t count = 0;
  for (const ShellBlock& block : mesh.shells) count += block.nodes.rows();
  return count;
}

std::string summary_of(const Deck& deck) {
  const std::pair<int64_t, const char*> counts[] = {
      {deck.mesh.nodes.rows(), "nodes"},
      {deck.mesh.cell_count(), "cells"},
      {shells_in(deck.mesh), "shells"},
      {deck.mesh.regions.size(), "regions"},
      {deck.points.size(), "points"},
      {deck.rigid.size() + deck.distributing.size(), "couplings"},
      {deck.ties.size(), "ties"},
      {deck.bolts.size(), "bolts"},
      {deck.equations.size(), "equations"},
      {deck.springs.size(), "springs"},
      {deck.beams.size(), "beams"},
      {deck.masses.size(), "masses"},
      {deck.steps.size(), "steps"}};
  std::vector<std::string> words;
  for (const auto& [count, what] : counts)
    if (count > 0) words.push_back(fmt::format("{}: {}", what, count));
  return fmt::format("{}", fmt::join(words, ", "));
}

// What the reader says of a deck that it reads.
void add_remarks(const Deck& deck, std::vector<CheckedRow>& rows) {
  for (const auto& [name, count] : deck.ignored) {
    const bool listed =
        std::any_of(rows.begin(), rows.end(), [&, &name = name](const CheckedRow& row) {
          return row.name == name && row.fate == "ignored";
        });
    if (!listed) rows.push_back({count, "", name, "left out", "", ""});
  }
  for (const Repair& done : deck.renumbered)
    rows.push_back({done.cells, "", "", "renumbered", "", done.text});
  for (const std::string& note : deck.notes) {
    const auto [where, text] = divided(note);
    rows.push_back({1, "", "", "noted", where, text});
  }
}

// Positions in the folder of the deck are written without it, remarks on all of it without its
// name.
void shorten(const std::filesystem::path& deck, CheckedRow& row) {
  const std::string folder = deck.parent_path().string() + "/", name = deck.filename().string();
  for (std::string* text : {&row.where, &row.remark})
    for (size_t at = deck.has_parent_path() ? text->find(folder) : std::string::npos;
         at != std::string::npos; at = text->find(folder, at))
      text->erase(at, folder.size());
  if (row.remark.starts_with(name + ": ")) row.remark.erase(0, name.size() + 2);
}

}  // namespace

CheckedDeck check_deck(const std::filesystem::path& path, const std::vector<std::string>& ignore) {
  Contents contents;
  CheckedDeck checked;
  try {
    // Only the proofs depend on units, and not on which.
    const Deck deck =
        read_deck(path, unit_system_named("m-kg-s", "units"), {ignore, std::nullopt, &contents});
    checked.rows = rows_of(contents);
    add_remarks(deck, checked.rows);
    checked.summary = summary_of(deck);
  } catch (const DeckRefused& refused) {
    checked.rows = rows_of(contents);
    for (const Refusal& refusal : refused.refusals) add_refusal(refusal, checked.rows);
  } catch (const InputError& error) {
    checked.rows = rows_of(contents);
    const auto [where, text] = divided(error.what());
    checked.rows.push_back({1, "", "", "refused", where, text});
  }
  for (CheckedRow& row : checked.rows) shorten(path, row);
  checked.refused = std::count_if(checked.rows.begin(), checked.rows.end(),
                                  [](const CheckedRow& row) { return row.fate == "refused"; });
  return checked;
}

std::vector<std::string> table_of(const CheckedDeck& checked) {
  std::vector<std::array<std::string, 5>> cells = {
      {"count", "in the deck", "clatter", "first at", ""}};
  for (const CheckedRow& row : checked.rows)
    cells.push_back({std::to_string(row.count),
                     row.kind.empty() ? row.name : fmt::format("{} {}", row.kind, row.name),
                     row.fate, row.where, row.remark});
  std::array<size_t, 5> width{};
  for (const auto& row : cells)
    for (size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  std::vector<std::string> lines;
  for (const auto& row : cells) {
    std::string line = fmt::format("{:>{}}", row[0], width[0]);
    for (size_t k = 1; k < row.size(); ++k) line += fmt::format("  {:<{}}", row[k], width[k]);
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(std::move(line));
  }
  return lines;
}

JsonMembers json_of(const CheckedDeck& checked) {
  std::vector<std::string> rows;
  for (const CheckedRow& row : checked.rows)
    rows.push_back(json_object({{"count", std::to_string(row.count)},
                                {"kind", json_text(row.kind)},
                                {"name", json_text(row.name)},
                                {"fate", json_text(row.fate)},
                                {"where", json_text(row.where)},
                                {"remark", json_text(row.remark)}}));
  return {{"rows", fmt::format("[{}]", fmt::join(rows, ", "))},
          {"refused", std::to_string(checked.refused)}};
}

}  // namespace clatter::mesh::deck
