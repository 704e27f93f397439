// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Film fields of some instants.
#include <cstdint>
#include <string>
#include <utility>

#include "core/base/h5_file.hpp"
#include "dynamics/component/field_stream.hpp"
#include "dynamics/film/piston_liner.hpp"
#include "dynamics/law/archive.hpp"

namespace clatter::dynamics {

/// The film of one contact: the pads' cell centres once, their fields in single precision.
class FilmStream {
 public:
  /// `file` and `contact` outlive the stream. @param group `film`, or that of one of several
  /// contacts.
  FilmStream(H5File& file, const film::PistonLiner& contact, std::string group)
      : file_(&file), contact_(&contact), group_(std::move(group)), fields_(file) {}
  /// The fields of all pads of the last accepted state.
  void add();
  /// Writes what is held, at the end or before.
  void finish() { fields_.finish(); }
  /// Whether the file has the cell centres.
  void archive(Archive& archive) { archive(first_); }
  /// Numbers in memory.
  int64_t held() const { return fields_.held(); }

 private:
  H5File* file_;
  const film::PistonLiner* contact_;
  std::string group_;
  FieldStream fields_;
  bool first_ = true;
};

}  // namespace clatter::dynamics
