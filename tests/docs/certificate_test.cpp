// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of all stages: their lists of fields are complete, come back from files, and are the
// tables of docs/formats.md.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "assembly/model/fe_certificate.hpp"
#include "core/rom/reduced_certificate.hpp"
#include "dynamics/run/run_certificate.hpp"
#include "mesh/repair/mesh_certificate.hpp"
#include "modal/certificates.hpp"
#include "recover/field/field_certificate.hpp"
#include "recover/sound/sound_certificate.hpp"
#include "tests/paths.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter {
namespace {

/// Calls check.operator()<C>(kind) for the certificate of each kind of artefact.
template <class Check>
void for_each_certificate(const Check& check) {
  check.template operator()<mesh::MeshCertificate>("mesh");
  check.template operator()<assembly::FeCertificate>("fe");
  check.template operator()<modal::ModesCertificate>("modes");
  check.template operator()<modal::StaticCertificate>("static");
  check.template operator()<modal::ShapeCertificate>("shape");
  check.template operator()<rom::ReducedCertificate>("rom");
  check.template operator()<dynamics::RunCertificate>("run");
  check.template operator()<recover::FieldCertificate>("field");
  check.template operator()<recover::SoundCertificate>("sound");
}

/// A certificate with another number in each field; optional ones and families only every `step`.
template <class C>
C filled(int step) {
  C certificate;
  int i = 0;
  for (const CertificateField<C>& field : C::fields())
    field.visit(certificate, [&]<class T>(T& value) {
      const double number = ++i + 1.0 / 3.0;
      if constexpr (std::is_same_v<T, double>)
        value = number;
      else if (i % step != 0)
        return;
      else if constexpr (std::is_same_v<T, CertificateNumbers>)
        value = {{"block", number}, {"liner_2", -number}};
      else
        value = number;
    });
  return certificate;
}

class Certificates : public ::testing::Test {
 protected:
  Certificates() {
    std::string name = test::scratch_path("certificate_XXXXXX");
    folder_ = ::mkdtemp(name.data());
  }
  ~Certificates() override { std::filesystem::remove_all(folder_); }

  H5File written(const CertificateNumbers& numbers) const {
    H5File file = H5File::create(folder_ / "a.h5");
    file.set("/", "schema", "clatter/test/1");
    write_certificate_numbers(file, numbers);
    file.commit();
    return H5File::open(folder_ / "a.h5");
  }

  std::filesystem::path folder_;
};

TEST_F(Certificates, FieldsNameEveryMemberOnce) {
  for_each_certificate([]<class C>(const char* kind) {
    C certificate;
    std::set<const void*> members;
    std::set<std::string> names;
    size_t bytes = 0;
    for (const CertificateField<C>& field : C::fields()) {
      names.insert(field.name);
      field.visit(certificate, [&](auto& value) {
        members.insert(&value);
        bytes += sizeof value;
      });
    }
    EXPECT_EQ(names.size(), C::fields().size()) << kind;
    EXPECT_EQ(members.size(), C::fields().size()) << kind;
    EXPECT_EQ(bytes, sizeof(C)) << kind << ": a member is in no field";
  });
}

TEST_F(Certificates, ComeBackWithTheNumbersThatArePresent) {
  for_each_certificate([&]<class C>(const char* kind) {
    for (const int step : {1, 2, 3, 1000}) {  // 1000: no optional number
      const C certificate = filled<C>(step);
      const H5File file = written(certificate_numbers(certificate));
      EXPECT_EQ(read_certificate<C>(file), certificate) << kind << ", every " << step;
      if (certificate_numbers(certificate).empty()) continue;
      for (const std::string& name : file.attributes("certificate"))
        EXPECT_EQ(certificate_numbers(certificate).count(name), 1u) << name;
    }
  });
}

TEST_F(Certificates, AbsentNumbersAreNotWritten) {
  mesh::MeshCertificate certificate;
  certificate.poor_cells = 0.0;
  const CertificateNumbers numbers = certificate_numbers(certificate);
  EXPECT_EQ(numbers.at("poor_cells"), 0.0);
  EXPECT_EQ(numbers.count("cells"), 1u);
  EXPECT_EQ(numbers.count("cad_volume_m3"), 0u);
  EXPECT_TRUE(certificate_numbers(rom::ReducedCertificate{}).empty());
}

TEST_F(Certificates, AFamilyHoldsTheNamesThatNoOtherFieldHas) {
  const H5File file = written({{"energy_residue", 1.0},
                               {"energy_exchanged", 2.0},
                               {"complete", 1.0},
                               {"cycles", 3.0},
                               {"steps_accepted", 4.0},
                               {"steps_rejected", 5.0},
                               {"periodicity_tilt", 6.0},
                               {"periodicity_block", 7.0},
                               {"of_a_later_version", 8.0}});
  const auto found = read_certificate<dynamics::RunCertificate>(file);
  EXPECT_EQ(found.tilt, 6.0);
  EXPECT_FALSE(found.lateral.has_value());
  EXPECT_EQ(found.velocity, (CertificateNumbers{{"block", 7.0}}));
  EXPECT_EQ(dynamics::periodicity_lines(found),
            (std::vector<std::string>{"periodicity_tilt: 6 rad", "periodicity_block: 7"}));
  EXPECT_TRUE(dynamics::periodicity_lines({}).empty());
}

TEST_F(Certificates, AReducedModelKeepsNumbersOfAnotherVersion) {
  const CertificateNumbers numbers{{"mass_error", 1e-12}, {"of_a_later_version", 8.0}};
  const auto found = read_certificate<rom::ReducedCertificate>(written(numbers));
  EXPECT_EQ(found.mass_error, 1e-12);
  EXPECT_EQ(certificate_numbers(found), numbers);
}

TEST_F(Certificates, ANumberOfEveryFileThatIsAbsentIsReported) {
  const H5File file = written({{"cells", 12.0}});
  test::expect_parts(test::refusal_of([&] { read_certificate<mesh::MeshCertificate>(file); }),
                     {"a.h5: certificate: found no nodes, expected a number"});
}

/// A certificate whose judged numbers are just good, but the field `other`.
template <class C>
C good_but(const std::string& other, double value) {
  C certificate;
  for (const CertificateField<C>& field : C::fields())
    field.visit(certificate, [&]<class T>(T& member) {
      if (!field.judgement.judges()) return;
      const double number = field.name == other ? value : field.judgement.good;
      if constexpr (std::is_same_v<T, CertificateNumbers>)
        member = {{"block", number}};
      else
        member = number;
    });
  return certificate;
}

/// What write_certificate() warns of, and the refusal.
template <class C>
std::string said_of(H5File file, const C& certificate) {
  ::testing::internal::CaptureStderr();
  std::string refusal;
  try {
    write_certificate(file, certificate);
  } catch (const NumericsError& error) {
    refusal = std::string("refused: ") + error.what();
  }
  std::string said = ::testing::internal::GetCapturedStderr();
  if (said.ends_with('\n')) said.pop_back();
  return said + refusal;
}

/// A number between the limits, and one beyond both.
std::pair<double, double> not_good(const Judgement& judgement) {
  const double sign = judgement.refused < judgement.good ? -1.0 : 1.0;
  if (!std::isfinite(judgement.refused)) return {judgement.good + sign, std::nan("")};
  return {0.5 * (judgement.good + judgement.refused),
          judgement.refused + sign * (1.0 + std::abs(judgement.refused))};
}

TEST_F(Certificates, EachJudgedNumberPassesWarnsAndIsRefused) {
  for_each_certificate([&]<class C>(const char* kind) {
    const auto said = [&](const std::string& name, double value) {
      return said_of(H5File::create(folder_ / "a.h5"), good_but<C>(name, value));
    };
    EXPECT_EQ(said("", 0.0), "") << kind;
    for (const CertificateField<C>& field : C::fields()) {
      const Judgement& judgement = field.judgement;
      if (!judgement.judges()) continue;
      const std::string all = field.name, name = all.substr(0, all.find('<'));
      const auto [between, beyond] = not_good(judgement);
      if (judgement.good != judgement.refused)
        test::expect_parts(said(field.name, between),
                           {"warning: ", "a.h5: " + name, judgement.good_text(), judgement.why});
      test::expect_parts(said(field.name, beyond),
                         {"refused: ", "a.h5: " + name, judgement.good_text(), judgement.why,
                          judgement.refused_text()});
    }
  });
}

TEST_F(Certificates, FilesKeepTheLimitsByWhichTheyWereJudged) {
  H5File file = H5File::create(folder_ / "a.h5");
  file.set("/", "schema", "clatter/test/1");
  write_certificate(file, good_but<modal::ShapeCertificate>("", 0.0));
  file.commit();
  const H5File read = H5File::open(folder_ / "a.h5");
  EXPECT_EQ(read.attributes("judged/good"), std::vector<std::string>{"covered"});
  EXPECT_EQ(read.get_double("judged/good", "covered"), 0.1);
  EXPECT_EQ(read.get_double("judged/refused", "covered"), -Judgement::kNever);
}

TEST_F(Certificates, WhatTellsOfQualityIsJudged) {
  // Of other bases than that of the file, without a limit that holds for all parts, or of no
  // consequence: M_rr is exact whatever its modes are scaled by.
  const std::set<std::string> not_judged{"frequency_error_joined",  "frequency_error_bound",
                                         "frequency_error_target",  "frequency_error_modes",
                                         "energy_imbalance",        "map_velocity_error",
                                         "poor_cells_volume_share", "modal_mass_error"};
  const std::regex quality(
      ".*(error|residue|residual_max|difference|closure|condition|proved|covered|mac|share|balance|"
      "rounding|jump|invalid_cells$|periodicity_<).*");
  for_each_certificate([&]<class C>(const char* kind) {
    for (const CertificateField<C>& field : C::fields()) {
      if (!std::regex_match(field.name, quality)) continue;
      EXPECT_NE(field.judgement.judges(), not_judged.contains(field.name))
          << kind << ": " << field.name;
    }
  });
}

/// All pages of keys and all READMEs of stages, in which options are.
std::string documents() {
  std::stringstream text;
  const std::filesystem::path source = CLATTER_SOURCE_DIR;
  for (const auto& page : std::filesystem::directory_iterator(source / "docs/keys"))
    text << std::ifstream(page.path()).rdbuf();
  for (const char* stage : {"mesh", "assembly", "modal", "condense", "dynamics", "recover"})
    text << std::ifstream(source / stage / "README.md").rdbuf();
  return text.str();
}

TEST_F(Certificates, AdviceNamesKeysAndOptionsThatExist) {
  const std::string known = documents();
  const std::regex name("--[a-z][a-z-]+|[a-z]+_[a-z_]+");
  int found = 0;
  for_each_certificate([&]<class C>(const char* kind) {
    std::set<std::string> own;  // other figures
    for (const CertificateField<C>& field : C::fields()) own.insert(field.name);
    for (const CertificateField<C>& field : C::fields()) {
      const std::string why = field.judgement.judges() ? field.judgement.why : "";
      for (std::sregex_iterator word(why.begin(), why.end(), name), end; word != end; ++word) {
        ++found;
        EXPECT_TRUE(own.contains(word->str()) || known.find(word->str()) != std::string::npos)
            << kind << ", " << field.name << ": " << word->str();
      }
    }
  });
  EXPECT_GT(found, 5);
}

/// The table `certificate` in the section of this kind of artefact in docs/formats.md.
std::string documented(const std::string& kind) {
  std::stringstream text;
  text << std::ifstream(CLATTER_SOURCE_DIR "/docs/formats.md").rdbuf();
  const std::string all = text.str();
  const size_t section = all.find("\n## `." + kind + ".h5`");
  const size_t table = all.find("| `certificate` |", section);
  const size_t next = all.find("\n## ", section + 1);
  if (table >= next) return "none";
  const size_t end = all.find("\n\n", table);
  return end == std::string::npos ? all.substr(table) : all.substr(table, end + 1 - table);
}

// Where this fails, the table to put into the document is the expected text.
TEST_F(Certificates, TablesInTheDocumentAreThoseOfTheFields) {
  for_each_certificate([]<class C>(const char* kind) {
    EXPECT_EQ(documented(kind), certificate_table<C>()) << kind;
  });
  EXPECT_EQ(documented("faces"), "none");
}

/// The table in the section of this kind of artefact in docs/certificates.md.
std::string documented_judgements(const std::string& kind) {
  std::stringstream text;
  text << std::ifstream(CLATTER_SOURCE_DIR "/docs/certificates.md").rdbuf();
  const std::string all = text.str(), title = "\n## `." + kind + ".h5`\n\n";
  const size_t section = all.find(title);
  if (section == std::string::npos) return "none";
  const size_t table = section + title.size(), end = all.find("\n\n", table);
  return end == std::string::npos ? all.substr(table) : all.substr(table, end + 1 - table);
}

// Where this fails, the table to put into the document is the expected text.
TEST_F(Certificates, JudgementsInTheDocumentAreThoseOfTheFields) {
  for_each_certificate([]<class C>(const char* kind) {
    EXPECT_EQ(documented_judgements(kind), judgement_table<C>()) << kind;
  });
}

}  // namespace
}  // namespace clatter
