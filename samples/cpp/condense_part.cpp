// SPDX-License-Identifier: GPL-3.0-or-later
// Condenses an assembled part to the DoFs of some sets and its modes below a frequency.
//   condense_part part.fe.h5 part.rom.h5 fmax_hz set ...
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "condense/condense.hpp"
#include "core/base/write_artefact.hpp"

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fputs("usage: condense_part part.fe.h5 part.rom.h5 fmax_hz set ...\n", stderr);
    return 2;
  }
  try {
    const auto model = clatter::fe::read_fe_model(argv[1]);
    clatter::condense::CondenseOptions options;
    options.modes.fmax_hz = std::atof(argv[3]);
    options.boundary.assign(argv + 4, argv + argc);

    clatter::StepClock clock;
    const auto reduced = clatter::condense::condense(model, options, clock);
    for (const std::string& line : clatter::condense::describe(reduced)) std::puts(line.c_str());

    // The old file is untouched until the new one is complete.
    clatter::write_artefact(
        argv[2], {clatter::rom::kRomSchema, "", {argv[1]}}, clock, {},
        [&](clatter::H5File& file) { clatter::rom::write_reduced_model(file, reduced); });
  } catch (const std::exception& error) {
    std::fprintf(stderr, "condense_part: %s\n", error.what());
    return 2;
  }
}
