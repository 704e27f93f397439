// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Physical groups of the elements of a Gmsh file, and which the user ignores.
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesh/cad/gmsh_session.hpp"
#include "mesh/deck/msh/scan.hpp"

namespace clatter::mesh {

class MshGroups {
 public:
  /// `ignore`: element kinds, group names, "NO GROUP"; any case.
  MshGroups(std::string path, const MshScan& scan, const std::vector<std::string>& ignore);

  /// Checks all elements; InputError for named groups that are empty, for duplicate names in a
  /// dimension, and for names that our files cannot store.
  void learn(const MshContents& contents);

  /// True, and counted once, when the user ignores the kind.
  bool skips(const MshElements& elements);
  /// Names of the element's groups without ignored ones; an element without any is counted once.
  std::vector<std::string> of(const MshElements& elements, size_t e);
  /// Group number of a cell's region, 0 if the file has none; nullopt when ignored. InputError
  /// for a cell in no group or in two.
  std::optional<int> region_of(const MshElements& elements, size_t e);
  std::string region_name(int group) const;

  const std::map<std::string, int64_t>& ignored() const { return ignored_; }

 private:
  std::vector<int> numbers_of(const MshElements& elements, size_t e) const;
  std::string name_of(int dim, int number) const;
  bool ignores(const std::string& name) const;
  std::string names_present(int dim) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  const MshScan& scan_;
  std::set<std::string> ignore_;                      // upper case
  std::map<std::pair<int, int>, std::string> names_;  // (dimension, number)
  std::set<std::pair<int, int>> used_;                // groups that have elements
  std::map<std::string, int64_t> ignored_;
  std::set<const MshElements*> counted_kinds_;
  std::set<size_t> counted_elements_;
};

}  // namespace clatter::mesh
