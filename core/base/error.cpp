// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/error.hpp"

#include <new>

#include "core/base/part_names.hpp"
#include "core/base/refusal.hpp"
#include "core/base/standard_streams.hpp"

namespace clatter {

int run_guarded(std::string_view program, const std::function<int()>& body) {
  secure_standard_streams();
  remove_parts_on_signals();
  try {
    const int code = body();
    finish_standard_output();
    return code;
  } catch (const Error& error) {
    return report_error(program, error.what(), error.code());
  } catch (const std::bad_alloc&) {
    return report_error(program, "out of memory: use a coarser mesh or fewer retained DoFs",
                        ExitCode::kNumerics);
  } catch (const std::exception& error) {
    return report_error(program, std::string("internal: ") + error.what(), ExitCode::kNumerics);
  } catch (const std::string& message) {
    return report_error(program, message, ExitCode::kNumerics);
  } catch (...) {
    return report_error(program, "internal: an exception of unknown kind", ExitCode::kNumerics);
  }
}

}  // namespace clatter
