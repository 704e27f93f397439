// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A box as an IGES 5.3 file: six rational B-spline surfaces (type 128) of degree 1, nothing else.
#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace clatter::mesh::testing {

/// Lines of 80 columns: data, section letter in column 73, number of the line in its section.
class IgesLines {
 public:
  explicit IgesLines(char section) : section_(section) {}
  void add(const std::string& data) {
    text_ += fmt::format("{:<72}{}{:7}\n", data, section_, ++count_);
  }
  int count() const { return count_; }
  const std::string& text() const { return text_; }

 private:
  char section_;
  int count_ = 0;
  std::string text_;
};

inline std::string iges_patch(const std::array<Eigen::Vector3d, 4>& p) {
  std::string text = "128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.";
  for (const Eigen::Vector3d& x : p) text += fmt::format(",{:.1f},{:.1f},{:.1f}", x[0], x[1], x[2]);
  return text + ",0.,1.,0.,1.;";
}

/// Corner at the origin, `size` in millimetres.
inline std::string iges_box(const Eigen::Vector3d& size) {
  IgesLines start('S'), global('G'), directory('D'), parameters('P'), end('T');
  start.add("box");
  global.add("1H,,1H;,3Hbox,7Hbox.igs,4Htest,4Htest,32,38,6,308,15,3Hbox,1.,2,2HMM,1,");
  global.add("0.01,15H20200101.000000,1.0E-6,100.,4Htest,4Htest,11,0,15H20200101.000000;");
  const auto entity = [&](int type, const std::string& data) {
    const int first = parameters.count() + 1, entry = directory.count() + 1;
    for (size_t from = 0; from < data.size();) {  // does not split numbers
      size_t length = std::min<size_t>(64, data.size() - from);
      if (from + length < data.size()) length = data.rfind(',', from + length - 1) - from + 1;
      parameters.add(fmt::format("{:<64}{:8}", data.substr(from, length), entry));
      from += length;
    }
    directory.add(fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:>8}", type, first, 0, 0, 0, 0, 0,
                              0, "00000000"));
    directory.add(fmt::format("{:8}{:8}{:8}{:8}{:8}{:>8}{:>8}{:>8}{:8}", type, 0, 0,
                              parameters.count() - first + 1, 0, "", "", "entity", 0));
  };
  entity(116, "116,0.,0.,0.,0;");  // a point: Gmsh 4.8.4 skips the first entity
  for (int d = 0; d < 3; ++d) {
    for (const double at : {0.0, size[d]}) {
      std::array<Eigen::Vector3d, 4> p;
      for (size_t i = 0; i < 4; ++i) {
        p[i][d] = at;
        p[i][(d + 1) % 3] = i % 2 == 0 ? 0.0 : size[(d + 1) % 3];
        p[i][(d + 2) % 3] = i < 2 ? 0.0 : size[(d + 2) % 3];
      }
      entity(128, iges_patch(p));
    }
  }
  end.add(fmt::format("S{:7}G{:7}D{:7}P{:7}", start.count(), global.count(), directory.count(),
                      parameters.count()));
  return start.text() + global.text() + directory.text() + parameters.text() + end.text();
}

}  // namespace clatter::mesh::testing
