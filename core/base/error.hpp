#pragma once
// What can go wrong, as types that carry the exit code, and the frame in which every main runs.
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace clatter {

/// Exit codes of every clatter executable.
enum class ExitCode : int { kDone = 0, kBadInput = 2, kNumerics = 3, kFileTrouble = 4 };

/// Base of all errors that a user sees: one line of text and the exit code that goes with it.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// The user's input is wrong: say the file, the place, what was found, what was expected.
struct InputError : Error {
  explicit InputError(const std::string& message) : Error(ExitCode::kBadInput, message) {}
};

/// A result was not reached or not proved: not converged, not definite, count mismatch.
struct NumericsError : Error {
  explicit NumericsError(const std::string& message) : Error(ExitCode::kNumerics, message) {}
};

/// A file could not be read, written, synced or renamed.
struct FileError : Error {
  explicit FileError(const std::string& message) : Error(ExitCode::kFileTrouble, message) {}
};

/// Runs `body`; an InputError of it gets `place` in front: the file whose words are wrong.
template <class Body>
auto with_place(const std::string& place, const Body& body) {
  try {
    return body();
  } catch (const InputError& error) {
    throw InputError(place + ": " + error.what());
  }
}

/// Runs the body of a main: prints any error as one line "`program`: error: ..." on stderr and
/// returns the exit code. std::string and unknown exceptions are caught as well (hard case G1).
int run_guarded(std::string_view program, const std::function<int()>& body);

}  // namespace clatter
