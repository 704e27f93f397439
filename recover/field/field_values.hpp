// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Datasets of a field file, each with its unit and meaning.
#include <fmt/format.h>

#include <Eigen/Core>
#include <string>

#include "core/base/h5_file.hpp"
#include "recover/spectrum/level_error.hpp"

namespace clatter::recover {

inline constexpr const char* kPhase =
    "x(t) = Re( X exp(+i 2 pi f t) ), t = 0 at crank angle 0 (at the first sample when nothing "
    "turns)";

template <typename Values>
void put(H5File& file, const std::string& name, const Values& values, const std::string& unit,
         const std::string& meaning) {
  file.write(name, values);
  file.set(name, "unit", unit);
  file.set(name, "meaning", meaning);
}

/// Peak amplitudes as `name`_re and `name`_im, of the real matrix or vector type `Real`.
template <typename Real>
void put_complex(H5File& file, const std::string& name, const auto& values, const std::string& unit,
                 const std::string& meaning) {
  put(file, name + "_re", Real(values.real()), unit, meaning + ", real part, peak amplitude");
  put(file, name + "_im", Real(values.imag()), unit, meaning + ", imaginary part, peak amplitude");
  for (const char* part : {"_re", "_im"}) {
    file.set(name + part, "amplitude", "peak");
    file.set(name + part, "phase", kPhase);
  }
}

/// Levels in dB with their reference.
void put_level(H5File& file, const std::string& name, const auto& values, double reference,
               const std::string& reference_unit, const std::string& meaning) {
  put(file, name, values, "dB",
      fmt::format("{}, dB re {:g} {}", meaning, reference, reference_unit));
  file.set(name, "reference", reference);
  file.set(name, "reference_unit", reference_unit);
}

/// Attributes `level`_standard_error_db and `level`_standard_error_dba of a mean over segments.
inline void set_level_error(H5File& file, const std::string& at, const std::string& level,
                            const LevelError& error) {
  if (error.db) file.set(at, level + "_standard_error_db", *error.db);
  if (error.dba) file.set(at, level + "_standard_error_dba", *error.dba);
}

}  // namespace clatter::recover
