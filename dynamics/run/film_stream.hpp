// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Film fields of some instants, which go to the run file block by block.
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/h5_file.hpp"
#include "dynamics/film/piston_liner.hpp"

namespace clatter::dynamics {

/// The film of one contact: the pads' cell centres once, their fields in single precision.
class FilmStream {
 public:
  /// `file` and `contact` outlive the stream. @param group `film`, or that of one of several
  /// contacts.
  FilmStream(H5File& file, const film::PistonLiner& contact, std::string group)
      : file_(&file), contact_(&contact), group_(std::move(group)) {}
  /// The fields of all pads of the last accepted state.
  void add();
  /// Writes what is left.
  void finish();
  /// Numbers in memory.
  int64_t held() const;

 private:
  struct Field {
    std::vector<float> values;  // frames x cells
    int64_t around = 0, along = 0;
    int64_t cells() const { return around * along; }
  };
  void put(const std::string& name, const RowMatrix& frame);
  void flush(const std::string& name, Field& field);
  H5File* file_;
  const film::PistonLiner* contact_;
  std::string group_;
  std::map<std::string, Field> fields_;  // by dataset
};

}  // namespace clatter::dynamics
