#include "experiments/parse_run_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "experiments/text.h"
#include "motions/input_error.h"

namespace kds {
namespace {

constexpr std::array kOptions{
    OptionSpec{"--structures", "LIST",
               "comma list of sorted, wrapped, power (default: wrapped,power;"
               " instances: sorted in 1D, else power)"},
    OptionSpec{"--motion", "NAME", "how beads move between frames: linear, hermite, lifted (default: linear)"},
    OptionSpec{"--kernel", "NAME", "fast, filtered or exact arithmetic (default: filtered)"},
    OptionSpec{"--topology", "FILE",
               "PDB or mmCIF that names the atoms of a DCD (default: its atoms are the beads)"},
    OptionSpec{"--select", "NAME",
               "backbone (N, CA, C), ca or all (default: backbone where residues are known)"},
    OptionSpec{"--chain", "ID", "the chain to read (default: the first polymer chain)"},
    OptionSpec{"--frames", "RANGE", "FIRST:LAST:STRIDE, from 0, LAST excluded (default: all)"},
    OptionSpec{"--radius", "RULE", "auto, a number, element, element:fit or file:PATH (default: auto)"},
    OptionSpec{"--audit", "WHEN", "compare with static builds: none, frames or events (default: none)"},
    OptionSpec{"--dump", "DIR", "write the structures at every frame there (default: none)"},
    OptionSpec{"--log", "FILE", "write the event log there, for kds replay (default: none)"},
    OptionSpec{"--out", "DIR", "write summary.json, events.csv and report.html there (default: none)"},
    OptionSpec{"--json", "FILE", "write the summary there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr CommandSpec kCommand{
    "kds run",
    "Runs kinetic structures over moving beads and reports every event, exactly and in order.",
    "INPUT...",
    "a necklace: .pdb .ent .cif .mmcif (also .gz), .dcd, .xyz, or an instance file",
    kOptions,
    "kds run villin.dcd --topology villin.pdb --frames 0:200 --structures wrapped,power --out report\n"
    "kds run models.pdb --kernel exact --audit events --json -",
};

template <class Value>
using Choice = std::pair<std::string_view, Value>;

constexpr std::array kKernels{Choice<KernelName>{"fast", KernelName::fast},
                              Choice<KernelName>{"filtered", KernelName::filtered},
                              Choice<KernelName>{"exact", KernelName::exact}};
constexpr std::array kAudits{Choice<AuditMode>{"none", AuditMode::none},
                             Choice<AuditMode>{"frames", AuditMode::frames},
                             Choice<AuditMode>{"events", AuditMode::events}};
constexpr std::array kSelections{Choice<Selection>{"backbone", Selection::backbone},
                                 Choice<Selection>{"ca", Selection::ca},
                                 Choice<Selection>{"all", Selection::all}};
constexpr std::array kMotions{Choice<FrameMotion>{"linear", FrameMotion::linear},
                              Choice<FrameMotion>{"hermite", FrameMotion::hermite},
                              Choice<FrameMotion>{"lifted", FrameMotion::lifted}};
constexpr std::array<std::string_view, 3> kStructures{"sorted", "wrapped", "power"};
constexpr std::array<std::string_view, 1> kStructuresToCome{"contacts"};

template <class Value, std::size_t count>
void choose(const ParsedArguments& parsed, std::string_view option,
            const std::array<Choice<Value>, count>& choices, Value& target) {
  const std::optional<std::string> word = parsed.value(option);
  if (!word) return;
  std::vector<std::string_view> names;
  for (const auto& [name, value] : choices) {
    if (name == *word) {
      target = value;
      return;
    }
    names.push_back(name);
  }
  throw InputError(fmt::format("{}: '{}' is not one of {}", option, *word, fmt::join(names, ", ")));
}

template <class Names>
bool among(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// In the order of kStructures whatever the order given, so that the same set gives the same run.
std::vector<std::string> parse_structures(const std::string& list) {
  const std::vector<std::string> names = split(list, ',');
  for (const std::string& name : names) {
    if (among(kStructuresToCome, name))
      throw InputError(fmt::format("--structures: {} is not available yet", name));
    if (!among(kStructures, name))
      throw InputError(
          fmt::format("--structures: '{}' is not one of {}", name, fmt::join(kStructures, ", ")));
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError(fmt::format("--structures: {} is listed twice", name));
  }
  std::vector<std::string> ordered;
  for (const std::string_view name : kStructures)
    if (among(names, name)) ordered.emplace_back(name);
  return ordered;
}

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

std::optional<std::filesystem::path> path_of(const ParsedArguments& parsed, std::string_view option) {
  const std::optional<std::string> text = parsed.value(option);
  if (!text) return std::nullopt;
  if (*text == "-") throw InputError(fmt::format("{} needs a path; - is for --json only", option));
  return std::filesystem::path(*text);
}

}  // namespace

RunOptions parse_run_options(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kCommand, arguments);
  RunOptions options;
  if (parsed.operands().empty()) throw InputError("kds run needs at least one INPUT (see kds run --help)");
  for (const std::string& input : parsed.operands()) {
    if (input.empty()) throw InputError("an INPUT is empty; give the path of a file");
    options.inputs.emplace_back(input);
  }
  if (const auto list = parsed.value("--structures")) options.structures = parse_structures(*list);
  choose(parsed, "--motion", kMotions, options.motion);
  choose(parsed, "--kernel", kKernels, options.kernel);
  options.reading.topology = path_of(parsed, "--topology");
  choose(parsed, "--select", kSelections, options.reading.selection);
  options.reading.chain = parsed.value("--chain");
  if (const auto range = parsed.value("--frames")) options.reading.frames = parse_frame_range(*range);
  if (const auto rule = parsed.value("--radius")) options.radius = parse_radius(*rule);
  choose(parsed, "--audit", kAudits, options.audit);
  options.dump = path_of(parsed, "--dump");
  options.log = path_of(parsed, "--log");
  options.out = path_of(parsed, "--out");
  options.json = parsed.value("--json");
  options.quiet = parsed.has("--quiet");
  return options;
}

}  // namespace kds
