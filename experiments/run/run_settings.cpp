#include "experiments/run/run_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <string_view>

#include "experiments/program/option_names.h"

namespace kds {

namespace {

// As the options take them; empty for all.
std::string levels_of(const NodeSelection& nodes) {
  NodeSelection levels = nodes;
  levels.beads.reset();
  return levels.restricts() ? fmt::format("{}:{}", nodes.first_level, std::uint64_t{nodes.last_level} + 1)
                            : "";
}
std::string beads_of(const NodeSelection& nodes) {
  return nodes.beads ? fmt::format("{}:{}", nodes.beads->first, std::uint64_t{nodes.beads->last} + 1) : "";
}
std::string tolerance_of(const RunOptions& options) {
  return options.tolerance
             ? fmt::format("{}{}", options.tolerance->amount, options.tolerance->of_radius ? "r" : "")
             : "";
}
std::string relax_of(const RunOptions& options) {
  return options.relax ? fmt::format("{}", *options.relax) : "";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> option_settings(const RunOptions& options) {
  const ReadOptions& reading = options.reading;
  return {{"motion", std::string(name_of(options.motion))},
          {"kernel", std::string(name_of(options.kernel))},
          {"audit", std::string(name_of(options.audit))},
          {"topology", reading.topology ? reading.topology->string() : ""},
          {"select", std::string(name_of(reading.selection))},
          {"chain", reading.chain.value_or("")},
          {"frames", name_of(reading.frames)},
          {"radius", options.radius},
          {"obstacle", options.obstacle ? options.obstacle->string() : ""},
          {"levels", levels_of(options.nodes)},
          {"nodes", beads_of(options.nodes)},
          {"apart", options.apart ? std::to_string(*options.apart) : ""},
          {"between", options.between ? std::string(name_of(*options.between)) : ""},
          {"tightness", options.tightness ? fmt::format("{}", *options.tightness) : ""},
          {"relax", relax_of(options)},
          {"tolerance", tolerance_of(options)},
          {"certify", options.certify ? "yes" : ""},
          {"rounds", options.rounds > 1 ? std::to_string(options.rounds) : ""}};
}

std::vector<std::string> option_arguments(const RunOptions& options) {
  std::vector<std::string> arguments;
  for (const auto& input : options.inputs) arguments.push_back(std::filesystem::absolute(input).string());
  const auto add = [&](std::string option, std::string value) {
    arguments.push_back(std::move(option));
    arguments.push_back(std::move(value));
  };
  if (!options.structures.empty()) add("--structures", fmt::format("{}", fmt::join(options.structures, ",")));
  add("--motion", std::string(name_of(options.motion)));
  add("--kernel", std::string(name_of(options.kernel)));
  add("--audit", std::string(name_of(options.audit)));
  const ReadOptions& reading = options.reading;
  if (reading.topology) add("--topology", std::filesystem::absolute(*reading.topology).string());
  if (reading.selection != Selection::automatic) add("--select", std::string(name_of(reading.selection)));
  if (reading.chain) add("--chain", *reading.chain);
  add("--frames", name_of(reading.frames));
  std::string radius = options.radius;
  if (radius.starts_with("file:")) radius = "file:" + std::filesystem::absolute(radius.substr(5)).string();
  add("--radius", radius);
  if (options.obstacle) add("--obstacle", std::filesystem::absolute(*options.obstacle).string());
  if (const std::string levels = levels_of(options.nodes); !levels.empty()) add("--levels", levels);
  if (const std::string beads = beads_of(options.nodes); !beads.empty()) add("--nodes", beads);
  if (options.apart) add("--apart", std::to_string(*options.apart));
  if (options.between) add("--between", std::string(name_of(*options.between)));
  if (options.tightness) add("--tightness", fmt::format("{}", *options.tightness));
  if (options.relax) add("--relax", relax_of(options));
  if (options.tolerance) add("--tolerance", tolerance_of(options));
  if (options.certify) arguments.emplace_back("--certify");
  if (options.rounds > 1) add("--rounds", std::to_string(options.rounds));
  return arguments;
}

}  // namespace kds
