#include "experiments/program/input_options.h"

#include <charconv>
#include <cmath>

#include "experiments/program/option_values.h"

namespace kds {

namespace {

constexpr std::array kSelections{Choice<Selection>{"backbone", Selection::backbone},
                                 Choice<Selection>{"ca", Selection::ca},
                                 Choice<Selection>{"all", Selection::all}};

std::string parse_radius(const std::string& rule) {
  if (rule == "auto" || rule == "element" || rule == "element:fit") return rule;
  if (constexpr std::string_view prefix = "file:"; rule.starts_with(prefix)) {
    if (rule.size() == prefix.size()) throw InputError("--radius: file: needs a path, as in file:radii.txt");
    return rule;
  }
  double number = 0;
  const auto [end, error] = std::from_chars(rule.data(), rule.data() + rule.size(), number);
  if (error == std::errc() && end == rule.data() + rule.size() && std::isfinite(number) && number > 0)
    return rule;
  throw InputError(
      fmt::format("--radius: '{}' is not auto, a positive number, element, element:fit or file:PATH", rule));
}

void check_exists(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(fmt::format("{}: no such file", path.string()));
  if (std::filesystem::is_directory(path, error))
    throw InputError(fmt::format("{}: is a directory, expected a file", path.string()));
}

}  // namespace

InputOptions parse_input_options(const ParsedArguments& parsed, std::string_view command) {
  InputOptions options;
  if (parsed.operands().empty())
    throw InputError(fmt::format("{0} needs at least one INPUT (see {0} --help)", command));
  for (const std::string& input : parsed.operands()) {
    if (input.empty()) throw InputError("an INPUT is empty; give the path of a file");
    options.inputs.emplace_back(input);
  }
  options.reading.topology = path_of(parsed, "--topology");
  options.reading.selection = chosen(parsed, "--select", kSelections).value_or(Selection::automatic);
  options.reading.chain = parsed.value("--chain");
  if (const auto range = parsed.value("--frames")) options.reading.frames = parse_frame_range(*range);
  if (const auto rule = parsed.value("--radius")) options.radius = parse_radius(*rule);
  return options;
}

void check_inputs_exist(const InputOptions& options) {
  for (const std::filesystem::path& input : options.inputs) check_exists(input);
  if (options.reading.topology) check_exists(*options.reading.topology);
}

}  // namespace kds
