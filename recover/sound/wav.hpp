// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The sound of a steady run for the ear.
#include <Eigen/Core>
#include <filesystem>
#include <string>

namespace clatter::recover {

/// How long a WAV file is, and how loud.
struct WavRule {
  double seconds = 4.0;
  double full_scale_pa = 0.0;  // pressure of the largest sample; 0: 1.25 times the peak
};

inline constexpr int kWavRate = 48000;  // samples per second

/// Pressure of a microphone during a cycle, which is repeated [Pa].
/// @param pressure lines, peak amplitudes; @param spacing_hz line k is at k spacing_hz
Eigen::VectorXd repeated_cycle(const Eigen::VectorXcd& pressure, double spacing_hz, double seconds);

/// A WAV file: one channel of 16 bits, 48 kHz (RIFF, PCM). InputError when the pressure exceeds the
/// full scale.
std::string wav_bytes(const Eigen::VectorXd& pressure, double full_scale_pa);

/// What was written.
struct WavSummary {
  double full_scale_pa = 0.0, peak_pa = 0.0, rms_pa = 0.0, to_hz = 0.0;
};

/// Writes the cycle of a field file with sound, as heard by a microphone.
/// @throws InputError for a file without a cycle or sound, or an unknown microphone
WavSummary write_wav(const std::filesystem::path& field, const std::string& microphone,
                     const WavRule& rule, const std::filesystem::path& wav);

}  // namespace clatter::recover
