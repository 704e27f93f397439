// SPDX-License-Identifier: GPL-3.0-or-later
// Other microphones from the surface pressures of an earlier sound file.
#include <gtest/gtest.h>

#include "sound_run.hpp"

namespace clatter::recover {
namespace {

using namespace testing;

class EarlierSound : public SoundRun {
 protected:
  static SoundOptions other_microphone() {
    SoundOptions options = sphere_options();
    options.microphones = {{"oblique", {0.5, 0.4, -0.3}}};
    return options;
  }
  static PartSound made(const SoundOptions& options, const EarlierSamples& earlier = {}) {
    StepClock clock;
    return part_sound(sphere_model(), options, clock, earlier);
  }
  EarlierSamples of_file() {
    return [this](const PartSound& sound) {
      return earlier_samples(folder_ / "part.sound.h5", rom_, sound);
    };
  }
  /// How many frequencies a sound with these options takes from the file; it is not made.
  size_t taken(const SoundOptions& options, const std::string& rom) {
    struct Taken {
      size_t count;
    };
    try {
      made(options, [&](const PartSound& sound) -> std::vector<SoundSample> {
        throw Taken{earlier_samples(folder_ / "part.sound.h5", rom, sound).size()};
      });
    } catch (const Taken& taken) {
      return taken.count;
    }
    throw std::logic_error("no earlier sound was asked for");
  }
};

TEST_F(EarlierSound, GivesOtherMicrophonesToTheBit) {
  const PartSound fresh = made(other_microphone()), again = made(other_microphone(), of_file());
  ASSERT_EQ(again.table.samples.size(), fresh.table.samples.size());
  for (size_t i = 0; i < fresh.table.samples.size(); ++i) {
    const SoundSample &one = fresh.table.samples[i], &other = again.table.samples[i];
    EXPECT_EQ(one.frequency_hz, other.frequency_hz);
    EXPECT_TRUE(one.H == other.H);
    EXPECT_TRUE(one.R == other.R);
    EXPECT_TRUE(one.far == other.far);
  }
  EXPECT_EQ(again.certificate, fresh.certificate);
  EXPECT_TRUE(again.efficiency == fresh.efficiency);
}

TEST_F(EarlierSound, IsWhatTheMicrophonesAreMadeOf) {
  const PartSound twice = made(other_microphone(), [&](const PartSound& sound) {
    std::vector<SoundSample> samples = earlier_samples(folder_ / "part.sound.h5", rom_, sound);
    for (SoundSample& sample : samples) sample.pressure *= 2.0f;
    return samples;
  });
  const PartSound once = made(other_microphone());
  // Of p dG/dn - G dp/dn the first part is twice as large: nothing was solved.
  EXPECT_GT((twice.table.samples[0].H - once.table.samples[0].H).norm(),
            0.1 * once.table.samples[0].H.norm());
}

TEST_F(EarlierSound, IsNotUsedWhereAnythingElseDiffers) {
  const size_t all = sphere_sound().table.samples.size();
  EXPECT_EQ(taken(other_microphone(), rom_), all);
  EXPECT_EQ(taken(other_microphone(), std::string(64, 'a')), 0U);
  SoundOptions air = other_microphone(), skin = air, ground = air;
  air.air.density = 1.3;
  EXPECT_EQ(taken(air, rom_), 0U);
  skin.skin.mesh.edges_per_wavelength = 9.0;
  EXPECT_EQ(taken(skin, rom_), 0U);
  ground.ground = sound::Plane{Eigen::Vector3d::UnitZ(), -2.0};
  EXPECT_EQ(taken(ground, rom_), 0U);
  H5File file = H5File::create(folder_ / "part.sound.h5");
  file.set("/", "schema", kSoundSchema);
  file.set("/", "version", version());
  SoundOptions without = sphere_options();
  without.surface_pressure = false;
  write_sound(file, sphere_sound(), without, rom_);
  file.commit();
  EXPECT_EQ(taken(other_microphone(), rom_), 0U);
  std::ofstream(folder_ / "part.sound.h5") << "no artefact";
  EXPECT_EQ(taken(other_microphone(), rom_), 0U);
  std::filesystem::remove(folder_ / "part.sound.h5");
  EXPECT_EQ(taken(other_microphone(), rom_), 0U);
}

}  // namespace
}  // namespace clatter::recover
