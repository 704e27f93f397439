// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "mesh/deck/nastran/fields.hpp"
#include "mesh/deck/nastran/lines.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

constexpr std::array<std::string_view, 23> kHarmlessExecutive = {
    "ACQUIRE",   "APP",    "ASSIGN",       "CEND", "CONNECT", "DIAG",   "DOMAINSOLVER", "ECHO",
    "ECHOOFF",   "ECHOON", "GEOMCHECK",    "ID",   "INIT",    "LABEL",  "MODEL_CHECK",  "NASTRAN",
    "RFINCLUDE", "SOL",    "SPARSESOLVER", "TIME", "VERSION", "EXPAND", "DBSETDEL"};

constexpr std::array<std::string_view, 114> kHarmlessCase = {
    "ACCELERATION",  "ACFPMRESULT", "ANALYSIS",    "AUTOSPC",     "AUXMODEL",      "B2GG",
    "B2PP",          "BCONTACT",    "BCRESULTS",   "BCSET",       "BGRESULTS",     "BOUTPUT",
    "BUCKLING",      "CMETHOD",     "DESGLB",      "DESOBJ",      "DESSUB",        "DESVAR",
    "DISPLACEMENT",  "DLOAD",       "DRSPAN",      "ECHO",        "ECHOOFF",       "ECHOON",
    "EDE",           "EKE",         "ELFORCE",     "ELSDCON",     "ELSTRAIN",      "ELSTRESS",
    "ELSUM",         "ENDTIME",     "ESE",         "EXTSEOUT",    "FLSTCNT",       "FLUX",
    "FORCE",         "FREQUENCY",   "GPFORCE",     "GPKE",        "GPSDCON",       "GPSTRAIN",
    "GPSTRESS",      "GROUNDCHECK", "HOUTPUT",     "IC",          "K42GG",         "LABEL",
    "LINE",          "LOADSET",     "MAXLINES",    "MAXMIN",      "MEFFMASS",      "MFLUID",
    "MODALKE",       "MODALSE",     "MODESELECT",  "MPCFORCES",   "NLPARM",        "NLSTEP",
    "NLSTRESS",      "NONLINEAR",   "NOUTPUT",     "OFREQUENCY",  "OLOAD",         "OMODES",
    "OTIME",         "OUTPUT",      "PAGE",        "PLOTID",      "PRESSURE",      "RANDOM",
    "REPCASE",       "RESVEC",      "RGYRO",       "RSMETHOD",    "SACCELERATION", "SDAMPING",
    "SDISPLACEMENT", "SEALL",       "SEDR",        "SEDV",        "SEEXCLUDE",     "SEFINAL",
    "SEKREDUCE",     "SELGENERATE", "SEMGENERATE", "SET",         "SHELLTHK",      "SKIP",
    "SPCFORCES",     "STRAIN",      "STRESS",      "STRESSES",    "STRFIELD",      "SUBSEQ",
    "SUBTITLE",      "SUPER",       "SUPORT1",     "SURFACE",     "SVECTOR",       "SVELOCITY",
    "THERMAL",       "TITLE",       "TSTEP",       "TSTEPNL",     "VARIABLE",      "VECTOR",
    "VELOCITY",      "VOLUME",      "VUGRID",      "WEIGHTCHECK", "XTITLE",        "YTITLE"};

// OptiStruct's lines before and within the case control.
constexpr std::array<std::string_view, 23> kOptiStruct = {
    "ANALYSIS", "CHECK",       "DGLOBAL", "FORMAT", "H3D",   "HISOUT",     "LISTMEM", "LOADLIB",
    "MSGLMT",   "OSTDIST",     "OUTFILE", "OUTPUT", "PRINT", "RESPRINT",   "RESTART", "RESULTS",
    "SCREEN",   "SENSITIVITY", "SENSOUT", "SHAPE",  "SHRES", "SYSSETTING", "TMPDIR"};

// Those that change what is read.
constexpr std::array<std::string_view, 2> kReadExecutive = {"CEND", "SOL"};
constexpr std::array<std::string_view, 16> kReadCase = {
    "ANALYSIS", "BEGIN", "BGSET", "K2GG", "K2PP",    "LOAD",    "M2GG",   "M2PP",
    "METHOD",   "MPC",   "PARAM", "SPC",  "STATSUB", "SUBCASE", "SUBCOM", "TEMPERATURE"};

// NAME(OPTIONS) = VALUE, in capitals.
struct Command {
  std::string name, options, value;
  bool assigned = false;  // there is a =
};

Command parse_command(std::string_view line) {
  Command out;
  const auto word = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  line = trimmed(without_comment(line));
  const auto end = std::find_if_not(line.begin(), line.end(), word);
  out.name = capitals(line.substr(0, static_cast<size_t>(end - line.begin())));
  line = trimmed(line.substr(out.name.size()));
  if (line.starts_with('(')) {
    const size_t close = std::min(line.find(')'), line.size() - 1);
    out.options = capitals(line.substr(1, close - 1));
    line = trimmed(line.substr(close + 1));
  }
  if (line.starts_with('=')) {
    out.assigned = true;
    line = trimmed(line.substr(1));
  } else if (line.starts_with(',')) {
    line = trimmed(line.substr(1));
  }
  out.value = capitals(line);
  return out;
}

// Four letters suffice for the name of a command.
bool is(const std::string& word, std::string_view name) {
  return word == name || (word.size() >= 4 && name.starts_with(word));
}

template <class Names>
bool is_one_of(const std::string& word, const Names& names) {
  return std::any_of(names.begin(), names.end(),
                     [&](std::string_view name) { return is(word, name); });
}

bool has_option(const Command& command, std::string_view option) {
  return command.options.find(option) != std::string::npos;
}

class ControlParser {
 public:
  ControlParser(Source& source, Ignore& ignore, Refusals& refusals)
      : source_(source), ignore_(ignore), refusals_(refusals) {}

  Control run() {
    while (const auto line = source_.next()) {
      if (follow_include(source_, *line)) continue;
      const Command command = parse_command(*line);
      if (command.name.empty() && trimmed(without_comment(*line)).empty()) continue;
      if (part_ == Part::kUnknown && !begins(command)) {
        source_.unread();
        return {};
      }
      if (command.name == "BEGIN" || command.name == "BEGIN_BULK") {
        begin_bulk(command);
        return finish();
      }
      if (part_ == Part::kExecutive && begins_cases(command)) part_ = Part::kCase;
      const std::string text(*line);
      const char* kind = part_ == Part::kExecutive ? "executive" : "case control";
      Content& content = refusals_.contents().count(kind, command.name, source_, source_.origin());
      content.fate = Fate::kRefused;
      refusals_.attempt([&] {
        content.fate = part_ == Part::kExecutive ? executive(command) : case_control(command, text);
      });
    }
    if (part_ == Part::kUnknown) return {};
    refusals_.require(
        [&] { source_.fail(source_.origin(), "found the end of the deck, expected BEGIN BULK"); });
    return {};
  }

 private:
  enum class Part { kUnknown, kExecutive, kCase };

  // Whether the first line of the deck is executive or case control, and which.
  bool begins(const Command& command) {
    const bool executive = std::find(kHarmlessExecutive.begin(), kHarmlessExecutive.end(),
                                     command.name) != kHarmlessExecutive.end();
    if (executive && !(command.assigned && command.name.starts_with("ECHO"))) {
      part_ = Part::kExecutive;
    } else if (command.assigned || command.name == "SUBCASE" || command.name == "TITLE" ||
               std::find(kOptiStruct.begin(), kOptiStruct.end(), command.name) !=
                   kOptiStruct.end()) {
      part_ = Part::kCase;
    }
    return part_ != Part::kUnknown || command.name.starts_with("BEGIN");
  }

  // A command of case control that ends the executive part without CEND.
  static bool begins_cases(const Command& command) {
    return (command.assigned || command.name == "SUBCASE" || command.name == "SET") &&
           !is_one_of(command.name, kHarmlessExecutive);
  }

  void begin_bulk(const Command& command) {
    if (command.value.empty() || command.value.starts_with("BULK")) return;
    source_.fail(source_.origin(),
                 fmt::format("found BEGIN {}, expected BEGIN BULK", shown(command.value)));
  }

  Fate executive(const Command& command) {
    if (command.name == "CEND") {
      part_ = Part::kCase;
    } else if (command.name == "SOL") {
      solution(command.value);
    } else if (is_one_of(command.name, kHarmlessExecutive)) {
      return Fate::kPassed;
    } else {
      return refuse(command.name, "executive statement");
    }
    return Fate::kRead;
  }

  void solution(std::string_view value) {
    value = value.substr(0, value.find_first_of(" ,"));
    if (const auto number = to_integer(value)) {
      control_.solution = *number;
    } else if (value == "SESTATIC" || value == "SESTATICS") {
      control_.solution = 101;
    } else if (value == "SEMODES") {
      control_.solution = 103;
    }
  }

  Fate case_control(const Command& command, const std::string& line) {
    control_.has_cases = true;
    if (plots_ && command.name != "SUBCASE" && command.name != "SUBCOM") return Fate::kPassed;
    if (command.name == "SUBCOM") {
      combines_ = true;
      control_.combinations.push_back(source_.origin());
    } else if (combines_ && command.name != "SUBCASE") {
      return Fate::kPassed;
    } else if (command.name == "SUBCASE") {
      plots_ = combines_ = false;
      control_.subcases.push_back({set_number(command), source_.origin(), above_});
    } else if (command.name == "PARAM") {
      const std::string_view text = command.value;
      const size_t gap = std::min(text.find_first_of(", ="), text.size());
      const size_t value = std::min(text.find_first_not_of(", =", gap), text.size());
      const std::string_view name = text.substr(0, gap);
      if (!read_parameter(control_, name, text.substr(value), source_, source_.origin()))
        return Fate::kPassed;
    } else if (!choose(command)) {
      if (is(command.name, "OUTPUT"))
        plots_ = has_option(command, "PLOT") || has_option(command, "XY");
      if (command.name == "SET") skip_list(line);
      if (!is_one_of(command.name, kHarmlessCase) && !is_one_of(command.name, kOptiStruct))
        return refuse(command.name, "case control command");
      return Fate::kPassed;
    }
    return Fate::kRead;
  }

  bool choose(const Command& command) {
    Choice& choice = control_.subcases.empty() ? above_ : control_.subcases.back().choice;
    if (command.name == "SPC") {
      choice.spc = set_number(command);
    } else if (command.name == "MPC") {
      choice.mpc = set_number(command);
    } else if (command.name == "LOAD") {
      choice.load = set_number(command);
    } else if (is(command.name, "METHOD")) {
      if (!has_option(command, "FLUID")) choice.method = set_number(command);
    } else if (command.name == "STATSUB") {
      control_.preloads.push_back(source_.origin());
    } else if (command.name == "BGSET") {
      control_.glue = set_number(command);
    } else if (command.name == "K2GG" || command.name == "K2PP") {
      add_direct(command, control_.direct_stiffness);
    } else if (command.name == "M2GG" || command.name == "M2PP") {
      add_direct(command, control_.direct_mass);
    } else if (is(command.name, "ANALYSIS") && command.value.starts_with("STAT")) {
      choice.analysis = 101;
    } else if (is(command.name, "ANALYSIS") && command.value.starts_with("MODE")) {
      choice.analysis = 103;
    } else if (is(command.name, "TEMPERATURE")) {
      temperature(command, choice);
    } else {
      return false;
    }
    return true;
  }

  // NAME, or 0.5*NAME, 2.*OTHER.
  void add_direct(const Command& command, std::map<std::string, double>& names) {
    std::string_view rest = command.value;
    while (!rest.empty()) {
      const size_t comma = std::min(rest.find(','), rest.size());
      std::string_view name = trimmed(rest.substr(0, comma));
      rest = rest.substr(std::min(comma + 1, rest.size()));
      double factor = 1.0;
      if (const size_t star = name.find('*'); star != std::string_view::npos) {
        const auto number = to_number(trimmed(name.substr(0, star)));
        if (!number) refuse_direct(command);
        factor = *number;
        name = trimmed(name.substr(star + 1));
      }
      if (name.empty() || name.find_first_of("() ") != std::string_view::npos)
        refuse_direct(command);
      names[std::string(name)] += factor;
    }
  }

  [[noreturn]] void refuse_direct(const Command& command) {
    source_.fail(
        source_.origin(),
        fmt::format("{}: found {}, expected names of DMIG, each with a real factor or none",
                    command.name, shown(command.value)));
  }

  void temperature(const Command& command, Choice& choice) {
    const int32_t set = set_number(command);
    const bool both = command.options.empty() || has_option(command, "BOTH");
    if (has_option(command, "MATE")) {  // constants do not depend on temperature here
      control_.material_temperatures.push_back(source_.origin());
      return;
    }
    if (has_option(command, "INIT")) {
      control_.initial_temperature = set;
    } else if (both || has_option(command, "LOAD")) {
      choice.temperature = set;
    } else {
      source_.fail(source_.origin(),
                   fmt::format("{}({}) is not supported, expected LOAD or INITIAL", command.name,
                               command.options));
    }
  }

  int32_t set_number(const Command& command) {
    const auto number = to_integer(command.value);
    if (number && *number > 0) return *number;
    source_.fail(source_.origin(), fmt::format("{}: found {}, expected the number of a set",
                                               command.name, shown(command.value)));
  }

  // Lists of output sets continue after a comma.
  void skip_list(std::string_view line) {
    while (without_comment(line).ends_with(',')) {
      const auto more = source_.next();
      if (!more) return;
      line = *more;
    }
  }

  Fate refuse(const std::string& name, const char* kind) {
    if (ignore_.skips(name)) return Fate::kIgnored;
    source_.fail(source_.origin(), fmt::format("{} {} is not supported; ignore = [\"{}\"] skips it",
                                               kind, shown(name), name));
  }

  Control finish() {
    control_.has_cases = control_.has_cases || part_ == Part::kCase;
    if (control_.has_cases && control_.subcases.empty()) {
      control_.subcases.push_back({1, source_.origin(), above_});
    }
    return control_;
  }

  Source& source_;
  Ignore& ignore_;
  Refusals& refusals_;
  Part part_ = Part::kUnknown;
  Control control_;
  Choice above_;           // selected above the first subcase: for all
  bool plots_ = false;     // after OUTPUT(PLOT): plotter commands
  bool combines_ = false;  // after SUBCOM, until the next SUBCASE
};

}  // namespace

Control read_control(Source& source, Ignore& ignore, Refusals& refusals) {
  return ControlParser(source, ignore, refusals).run();
}

std::vector<Listed> listed_commands() {
  const auto is_read = [](std::string_view name) {
    return std::ranges::count(kReadExecutive, name) + std::ranges::count(kReadCase, name) > 0;
  };
  std::vector<Listed> rows;
  const auto list = [&](const auto& names, Fate fate, const char* where) {
    for (const std::string_view name : names)
      if (fate == Fate::kRead || !is_read(name)) rows.push_back({std::string(name), fate, where});
  };
  list(kReadExecutive, Fate::kRead, "executive");
  list(kHarmlessExecutive, Fate::kPassed, "executive");
  list(kReadCase, Fate::kRead, "case control; four letters suffice");
  list(kHarmlessCase, Fate::kPassed, "case control; four letters suffice");
  list(kOptiStruct, Fate::kPassed, "OptiStruct");
  return rows;
}

bool read_parameter(Control& control, std::string_view name, std::string_view value,
                    const Source& source, Origin origin) {
  const auto number = [&] {
    const auto found = to_number(value);
    if (!found)
      source.fail(origin, fmt::format("PARAM {}: found {}, expected a number", name, shown(value)));
    return *found;
  };
  if (name == "WTMASS") {
    const auto factor = to_number(value);
    if (!factor || !(*factor > 0.0)) {
      source.fail(origin,
                  fmt::format("PARAM WTMASS: found {}, expected a positive number", shown(value)));
    }
    control.mass_factor = *factor;
  } else if (name == "COUPMASS") {
    control.coupled_mass = number() > 0.0;
  } else if (name == "CK2") {
    control.direct_stiffness_factor = number();
  } else if (name == "CM2") {
    control.direct_mass_factor = number();
  } else if (name == "ALPHA1") {
    control.mass_damping = number();
  } else if (name == "ALPHA2") {
    control.stiffness_damping = number();
  } else if (name == "G") {
    control.loss_factor = number();
    if (!(control.loss_factor >= 0.0))
      source.fail(origin, fmt::format("PARAM G: found {}, expected a loss factor of 0 or more",
                                      shown(value)));
  } else if (name == "INREL") {
    control.inertia_relief = number() != 0.0;
  } else {
    return false;
  }
  return true;
}

}  // namespace clatter::mesh::deck::nastran
