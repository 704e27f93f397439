// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How good the numbers of certificates are: good, to be warned of, or refused.
#include <limits>
#include <string>
#include <vector>

namespace clatter {

enum class Verdict { kGood, kWarned, kRefused };

/// A number is good up to `good` and refused above `refused`, with a warning between. Where
/// `refused` is the smaller one it is good from `good` on and refused below `refused`. A number
/// that is NaN is refused. Without `why` it is a count or a size, which has no judgement.
struct Judgement {
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  double good = 0.0, refused = kNever;
  const char* why = nullptr;  // what a number means that is not good

  bool judges() const { return why != nullptr; }
  Verdict of(double value) const;
  /// "up to 0.001", "from 0.95"; and for the other limit "above 0.1", "below 0.5", "never".
  std::string good_text() const;
  std::string refused_text() const;
};

constexpr Judgement good_up_to(double good, const char* why,
                               double refused_above = Judgement::kNever) {
  return {good, refused_above, why};
}
constexpr Judgement good_from(double good, const char* why) {
  return {good, -Judgement::kNever, why};
}

/// A judged number.
struct Judged {
  std::string name;
  double value = 0.0;
  Judgement judgement;

  Verdict verdict() const { return judgement.of(value); }
};

/// Whether a number is refused.
bool any_refused(const std::vector<Judged>& numbers);

/// Warns of the numbers that are not good, `context` before them; those of one judgement, as of a
/// family, in one line: "energy_residue is 0.02, good up to 0.001: ...".
/// @throws NumericsError for those that are refused, all in one line
void require_trust(const std::string& context, const std::vector<Judged>& numbers);

}  // namespace clatter
