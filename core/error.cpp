#include "core/error.hpp"

#include <cstdio>
#include <new>

#include "core/part_names.hpp"

namespace clatter {
namespace {

int report(std::string_view program, const std::string& message, ExitCode code) {
  std::fprintf(stderr, "%.*s: error: %s\n", static_cast<int>(program.size()), program.data(),
               message.c_str());
  return static_cast<int>(code);
}

}  // namespace

int run_guarded(std::string_view program, const std::function<int()>& body) {
  remove_parts_on_signals();
  try {
    return body();
  } catch (const Error& error) {
    return report(program, error.what(), error.code());
  } catch (const std::bad_alloc&) {
    return report(program, "out of memory: use a coarser mesh or fewer retained degrees of freedom",
                  ExitCode::kNumerics);
  } catch (const std::exception& error) {
    return report(program, std::string("internal: ") + error.what(), ExitCode::kNumerics);
  } catch (const std::string& message) {
    return report(program, message, ExitCode::kNumerics);
  } catch (...) {
    return report(program, "internal: an exception of unknown kind", ExitCode::kNumerics);
  }
}

}  // namespace clatter
