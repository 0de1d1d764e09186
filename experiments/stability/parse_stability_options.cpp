#include "experiments/stability/parse_stability_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "motions/base/input_error.h"

namespace kds {
namespace {

constexpr std::array kStabilityOptions{
    OptionSpec{"--subjects", "LIST", "comma list of certificate types and structures (default: all)"},
    OptionSpec{"--extremes", "LIST", "comma list of extremes, or of their families (default: all)"},
    OptionSpec{"--cases", "N",
               "random cases of each extreme, fewer for degrees above 6 and for radicals, one run of a"
               " structure for 50, cubic 100 (default: 200)"},
    OptionSpec{"--seed", "N", "which random cases (default: 1)"},
    OptionSpec{"--out", "DIR", "write stability.json, stability.csv and report.html there (default: none)"},
    OptionSpec{"--json", "FILE", "write the rows there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr CommandSpec kStabilityCommand{
    "kds stability",
    "Compares the three kernels where arithmetic is hardest: filtered must agree with exact everywhere.",
    "",
    "",
    kStabilityOptions,
    "kds stability --out stability\n"
    "kds stability --subjects power_test,power --extremes scale,offset:2^50 --cases 1000",
};

std::string family(std::string_view extreme) { return std::string(extreme.substr(0, extreme.find(':'))); }

template <class Names>
bool among(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> parse_names(std::string_view option, const std::string& list,
                                     const std::vector<std::string>& known) {
  const std::vector<std::string> names = split(list, ',');
  for (const std::string& name : names) {
    if (!among(known, name))
      refuse_unknown(option, name, std::vector<std::string_view>(known.begin(), known.end()));
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError(fmt::format("{}: {} is listed twice", option, name));
  }
  return names;
}

std::vector<std::string> subject_names() {
  std::vector<std::string> names;
  for (const StabilitySubject& subject : all_subjects())
    if (!among(names, subject.name)) names.push_back(subject.name);
  return names;
}

std::vector<std::string> extreme_names() {
  std::vector<std::string> names;
  for (const Extreme& extreme : all_extremes()) {
    if (!among(names, family(extreme.name))) names.push_back(family(extreme.name));
    names.emplace_back(extreme.name);
  }
  return names;
}

}  // namespace

bool StabilityOptions::wants(const StabilitySubject& subject) const {
  return subjects.empty() || among(subjects, subject.name);
}

bool StabilityOptions::wants(const Extreme& extreme) const {
  return extremes.empty() || among(extremes, extreme.name) || among(extremes, family(extreme.name));
}

StabilityOptions parse_stability_options(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kStabilityCommand, arguments);
  StabilityOptions options;
  if (const auto list = parsed.value("--subjects"))
    options.subjects = parse_names("--subjects", *list, subject_names());
  if (const auto list = parsed.value("--extremes"))
    options.extremes = parse_names("--extremes", *list, extreme_names());
  if (const auto text = parsed.value("--cases"))
    options.cases.cases = parse_whole_number("--cases", *text, 1, 1'000'000);
  if (const auto text = parsed.value("--seed"))
    options.cases.seed = parse_whole_number("--seed", *text, 0, ~std::uint64_t{0});
  options.out = path_of(parsed, "--out");
  options.json = parsed.value("--json");
  options.quiet = parsed.has("--quiet");
  return options;
}

}  // namespace kds
