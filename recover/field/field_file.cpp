// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/field/field_file.hpp"

#include "recover/field/field_values.hpp"

namespace clatter::recover {
namespace {

void write_panel_result(H5File& file, const std::string& at, const PanelResult& panel,
                        double skin_erp, const LevelReferences& ref, bool samples) {
  put(file, at + "/mean_square_velocity", panel.mean_square_velocity, "m2/s2",
      "mean square normal velocity (RMS^2) per line, over time and surface");
  put(file, at + "/erp", panel.erp, "W", "equivalent radiated power per line");
  if (samples)
    put(file, at + "/instant_mean_square_velocity", panel.instant_mean_square, "m2/s2",
        "surface mean of the squared normal velocity at each sample");
  put_level(file, at + "/third_octave/velocity_db", panel.band_velocity_db, ref.velocity, "m/s",
            "mean square normal velocity per third octave");
  put_level(file, at + "/third_octave/erp_db", panel.band_erp_db, ref.power, "W",
            "equivalent radiated power per third octave");
  put_level(file, at + "/third_octave/erp_dba", panel.band_erp_dba, ref.power, "W",
            "A-weighted equivalent radiated power per third octave, weighted line by line");
  file.set(at, "area_m2", panel.area);
  file.set(at, "erp_w", panel.total_erp);
  file.set(at, "erp_db", level_db(panel.total_erp, ref.power));
  file.set(at, "erp_dba", level_db(panel.total_erp_a, ref.power));
  set_level_error(file, at, "erp", panel.erp_error);
  file.set(at, "share_of_skin", skin_erp > 0.0 ? panel.total_erp / skin_erp : 0.0);
}

void write_sensor_spectra(H5File& file, const std::string& at, const SensorResult& result) {
  const std::string lines = at + "/spectrum/";
  if (result.velocity_powers.size() > 0) {
    const std::string meaning =
        "mean square (RMS^2) per line, averaged over the segments, lines x channels";
    put(file, lines + "displacement_power", result.displacement_powers, "m2", meaning);
    put(file, lines + "velocity_power", result.velocity_powers, "m2/s2", meaning);
    put(file, lines + "acceleration_power", result.acceleration_powers, "m2/s4", meaning);
    return;
  }
  put_complex<Eigen::MatrixXd>(file, lines + "displacement", result.displacement_lines, "m",
                               "lines x channels");
  put_complex<Eigen::MatrixXd>(file, lines + "velocity", result.velocity_lines, "m/s",
                               "lines x channels");
  put_complex<Eigen::MatrixXd>(file, lines + "acceleration", result.acceleration_lines, "m/s2",
                               "lines x channels");
}

void write_sensor_result(H5File& file, const std::string& at, const SensorResult& result,
                         const LevelReferences& ref, const OutputRule& output) {
  const Sensor& sensor = *result.sensor;
  file.write(at + "/labels", sensor.labels);
  put(file, at + "/position", sensor.position, "m", "position of each channel");
  put(file, at + "/direction", sensor.direction, "1", "direction of each channel");
  put(file, at + "/is_rotation", sensor.is_rotation, "1",
      "1: the channel is an angle, read rad for m in all units");
  file.set(at, "kind", sensor.kind);
  if (output.samples) {
    put(file, at + "/displacement", result.displacement, "m", "samples x channels");
    put(file, at + "/velocity", result.velocity, "m/s", "samples x channels");
    put(file, at + "/acceleration", result.acceleration, "m/s2", "samples x channels");
  }
  if (output.spectra) write_sensor_spectra(file, at, result);
  put_level(file, at + "/third_octave/velocity_db", result.band_velocity_db, ref.velocity, "m/s",
            "mean square velocity, bands x channels");
  put_level(file, at + "/third_octave/acceleration_db", result.band_acceleration_db,
            ref.acceleration, "m/s2", "mean square acceleration, bands x channels");
}

void write_axes(H5File& file, const std::string& at, const Analysis& analysis) {
  put(file, at + "/time", analysis.time_s, "s", "samples, from crank angle 0");
  if (analysis.angle_deg.size() > 0)
    put(file, at + "/crank_angle_deg", analysis.angle_deg, "deg", "samples, from crank angle 0");
  const Eigen::VectorXd& frequency_hz = analysis.velocity.frequency_hz;
  put(file, at + "/frequency_hz", frequency_hz, "Hz", "lines");
  if (analysis.speed_hz > 0.0)
    put(file, at + "/order", Eigen::VectorXd(frequency_hz / analysis.speed_hz), "1",
        "lines as engine orders: multiples of the crank's speed");
  put(file, at + "/power_factor", analysis.velocity.power_factor, "1",
      "mean square = sum over lines of power_factor |X|^2; 1/2 over the taper's noise bandwidth");
  const ThirdOctaves& bands = analysis.bands;
  put(file, at + "/third_octave/mid_hz", bands.mid_hz, "Hz", "exact mid-bands, base ten");
  put(file, at + "/third_octave/lower_hz", bands.lower_hz, "Hz", "lower edges, mid 10^(-1/20)");
  put(file, at + "/third_octave/upper_hz", bands.upper_hz, "Hz", "upper edges, mid 10^(1/20)");
  file.write(at + "/third_octave/nominal", bands.nominal);
}

}  // namespace

std::string member_name(size_t index) { return fmt::format("{:05d}", index); }

void write_conventions(H5File& file, const Options& options, const FrequencyLimit& limit,
                       double valid_to_hz) {
  file.set("/", "phase", kPhase);
  file.set("/", "amplitude", "peak for complex lines, RMS^2 for mean squares");
  file.set("/", "frame", "the body's reference frame; displacements are small deviations in it");
  file.set("/", "normal", "out of the solid");
  file.set("/", "air_density_kg_m3", options.air.density);
  file.set("/", "air_sound_speed_m_s", options.air.sound_speed);
  file.set("/", "radiation_loss_factor", options.air.loss_factor);
  file.set("/", "velocity_reference_m_s", options.references.velocity);
  file.set("/", "acceleration_reference_m_s2", options.references.acceleration);
  file.set("/", "power_reference_w", options.references.power);
  file.set("/", "level_of_silence_db", kSilence);
  file.set("/", "basis_valid_to_hz", valid_to_hz);
  file.set("/", "spectra_from_hz", options.spectrum.from_hz);
  file.set("/", "spectra_to_hz", limit.to_hz);
  file.set("/", "spectra_limit", limit.reason);
}

void write_skin_geometry(H5File& file, const rom::Skin& skin, const SkinGeometry& geometry) {
  put(file, "skin/nodes", skin.nodes, "m", "coordinates");
  put(file, "skin/triangles", skin.triangles, "1",
      "quadratic triangles: 3 corners, then the mid-side nodes of edges 01, 12, 20; outward");
  put(file, "skin/face_area", geometry.face_area, "m2", "area of each triangle");
  put(file, "skin/face_normal", geometry.face_normal, "1", "mean outward unit normal");
  put(file, "skin/face_centre", geometry.face_centre, "m", "centre of each triangle");
  put(file, "skin/node_normal", geometry.node_normal, "1", "mean outward unit normal at each node");
  put(file, "skin/node_area", geometry.node_area, "m2", "share of the area, sums to it");
  file.set("skin", "area_m2", geometry.area);
  file.set("skin", "enclosed_volume_m3", geometry.volume);
}

void write_panels(H5File& file, const std::vector<Panel>& panels, bool with_faces) {
  std::vector<std::string> names;
  for (const Panel& panel : panels) {
    names.push_back(panel.name);
    if (with_faces)
      put(file, "panels/" + panel.name + "/faces", panel.faces, "1", "rows of skin/triangles");
    file.set("panels/" + panel.name, "area_m2", panel.area);
  }
  file.write("panel_names", names);
}

void write_analysis(H5File& file, const Analysis& analysis, const LevelReferences& references,
                    const OutputRule& output) {
  const std::string at = "analysis/" + analysis.piece.name;
  write_axes(file, at, analysis);
  file.store_single(output.single);
  const Piece& piece = analysis.piece;
  file.set(at, "periodic", piece.periodic ? "yes" : "no");
  file.set(at, "taper", name_of(piece.taper));
  file.set(at, "domain", name_of(piece.domain));
  file.set(at, "averages", piece.segments());
  file.set(at, "equivalent_averages", equivalent_averages(piece));
  file.set(at, "segment_samples", segment_of(piece, 0).count);
  file.set(at, "first_sample", piece.first);
  file.set(at, "samples", piece.count);
  file.set(at, "duration_s", piece.duration_s());
  file.set(at, "last_tenth_share", last_tenth_share(analysis));
  file.set(at, "ftdc_run_time_s", piece.ftdc_s);
  file.set(at, "speed_rpm", 60.0 * analysis.speed_hz);
  file.set(at, "line_spacing_hz", analysis.velocity.spacing_hz());
  const double skin_erp = analysis.panels.empty() ? 0.0 : analysis.panels.front().total_erp;
  for (const PanelResult& panel : analysis.panels)
    write_panel_result(file, at + "/panels/" + panel.name, panel, skin_erp, references,
                       output.samples);
  for (const SensorResult& sensor : analysis.sensors)
    write_sensor_result(file, at + "/sensors/" + sensor.sensor->name, sensor, references, output);
  file.store_single(false);
}

}  // namespace clatter::recover
