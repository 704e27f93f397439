// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// MP and MPDATA of ANSYS archives.
#include <map>
#include <string>
#include <vector>

#include "mesh/deck/deck.hpp"
#include "mesh/deck/msh/text_lines.hpp"

namespace clatter::mesh {

class CdbMaterials {
 public:
  /// MP, label, material, value.
  void read_mp(const TextLines& line, const std::vector<std::string>& fields);
  /// MPDATA, [R5.0,] count, label, material, first temperature, values.
  void read_mpdata(const TextLines& line, const std::vector<std::string>& fields);
  bool has(int number) const { return values_.contains(number); }
  /// InputError when E and nu are missing, or differ by temperature.
  deck::Material material(int number) const;

 private:
  struct Value {
    double first = 0.0;
    bool varies = false;  // with the temperature
    std::string where;
  };
  double value(int number, const std::string& label, double fallback) const;

  std::map<int, std::map<std::string, Value>> values_;
};

}  // namespace clatter::mesh
