// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Standard input, output and error of a program whose caller closed them, or stopped reading
// (hard case P8), and signals of writing.

namespace clatter {

/// Opens /dev/null for each of the three that is closed: the next file to be opened would take its
/// number, and messages would be written into an artefact. A pipe that nobody reads does not end
/// the process; what is written to it is lost. A limit of the size of files (RLIMIT_FSIZE) is a
/// failed write as on a full disk, not a signal that ends the process (hard case P11).
void secure_standard_streams();

/// Writes what is left for standard output. FileError when that, or anything before, could not be
/// written, as on a full disk; a reader that has gone is no error.
void finish_standard_output();

}  // namespace clatter
