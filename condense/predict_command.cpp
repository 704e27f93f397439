// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/predict_command.hpp"

#include <fmt/format.h>

#include "condense/condense.hpp"
#include "condense/predict/cost_lines.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::condense {
namespace {

constexpr int kMostRanks = 65536;
constexpr double kMostGflops = 1e5;

struct PredictArguments {
  CostRequest request;
  std::filesystem::path config;
};

void predict(const PredictArguments& a, const CommonOptions& common) {
  CostRequest request = a.request;
  if (request.ranks < 1 || request.ranks > kMostRanks)
    throw InputError(fmt::format("command line: --ranks: found {}, expected 1 to {}", request.ranks,
                                 kMostRanks));
  if (!(request.gflops >= 0.0 && request.gflops <= kMostGflops))
    throw InputError(fmt::format("command line: --gflops: found {}, expected above 0 to {:g}",
                                 request.gflops, kMostGflops));
  if (!a.config.empty()) request.boundary = condense_keys().read(Config::load(a.config)).boundary;
  const PredictedCost cost = predict_cost(request);
  for (const std::string& text : describe(cost)) print_result(text);
  if (common.json) print_json(json_of(cost));
}

}  // namespace

void declare_predict(CommandLine& program) {
  CommandLine& line = program.command(
      "predict", "Predicts what a reduction by several processes costs, from the graph of K.",
      "samples: clatter-condense predict block.fe.h5 -c block.rom.toml --ranks 32\n"
      "         clatter-condense predict block.fe.h5 --ranks 8 --gflops 20 --json");
  const auto a = std::make_shared<PredictArguments>();
  line.positional("model", a->request.model, "assembled part (.fe.h5)");
  line.option("-c,--config", a->config, "what to retain (.rom.toml); without it nothing");
  line.option("--ranks", a->request.ranks, "processes (default 32)");
  line.option("--gflops", a->request.gflops,
              "rate of one core in a factorisation [1e9 operations a second] (default: from a "
              "matrix product on this machine)");
  line.blas();
  line.action([a](const CommonOptions& common) { predict(*a, common); });
}

}  // namespace clatter::condense
