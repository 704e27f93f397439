// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Error types with their exit codes, and the error handler around every main.
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace clatter {

/// Exit codes of every clatter executable.
enum class ExitCode : int { kDone = 0, kBadInput = 2, kNumerics = 3, kFileTrouble = 4 };

/// Base of all errors shown to the user: one line of text and an exit code.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Invalid user input: give file, position, what was found, what was expected.
struct InputError : Error {
  explicit InputError(const std::string& message) : Error(ExitCode::kBadInput, message) {}
};

/// A result was not obtained or not proved: not converged, not definite, count mismatch.
struct NumericsError : Error {
  explicit NumericsError(const std::string& message) : Error(ExitCode::kNumerics, message) {}
};

/// A file could not be read, written, synced or renamed.
struct FileError : Error {
  explicit FileError(const std::string& message) : Error(ExitCode::kFileTrouble, message) {}
};

/// Runs `body`; prefixes the message of its InputError with `context`, for example the file.
template <class Body>
auto with_context(const std::string& context, const Body& body) {
  try {
    return body();
  } catch (const InputError& error) {
    throw InputError(context + ": " + error.what());
  }
}

/// Runs the body of a main; prints any error as one line "`program`: error: ..." on stderr and
/// returns the exit code. Also catches std::string and unknown exceptions (hard case G1).
int run_guarded(std::string_view program, const std::function<int()>& body);

}  // namespace clatter
