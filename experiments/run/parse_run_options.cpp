#include "experiments/run/parse_run_options.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

#include "certificates/base/relaxation.h"
#include "certificates/exact/exact_work.h"
#include "experiments/events/events_option.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option_lists.h"
#include "experiments/program/option_values.h"
#include "experiments/run/certify_stride.h"
#include "motions/base/input_error.h"

namespace kds {
namespace {

constexpr std::array kRunOptions{
    OptionSpec{
        "--structures", "LIST",
        "comma list of sorted, box, hull, closest, wrapped, layered, power, contacts (default: wrapped,power;"
        " instances: sorted in 1D, else power)"},
    OptionSpec{"--motion", "NAME",
               "how beads move between frames: linear, hermite, lifted (default: linear)"},
    OptionSpec{"--kernel", "NAME", "fast, filtered or exact arithmetic (default: filtered)"},
    OptionSpec{"--levels", "RANGE",
               "levels of wrapped and layered to keep, FIRST:LAST, roots 0, LAST excluded (default: all)"},
    OptionSpec{
        "--nodes", "RANGE",
        "nodes of wrapped and layered to keep, those over beads FIRST:LAST, LAST excluded (default: all)"},
    OptionSpec{"--between", "NAME",
               "wrapped between frames: events, the smallest spheres at all times, or chord, chords of those "
               "at the frames, without events (default: events)"},
    OptionSpec{"--tightness", "EPS",
               "with --between chord: radii proved to be within 1 + EPS of the smallest at all times, steps "
               "of nodes being halved for it (default: none)"},
    OptionSpec{"--apart", "K",
               "contacts: of beads of one chain, those at least K apart along it (default: 2)"},
    OptionSpec{"--relax", "EPS",
               "wrapped: a bead leaves a sphere when it is out by EPS of the radius, from 2^-20 to 1 "
               "(default: none)"},
    OptionSpec{"--tolerance", "DELTA",
               "beads go straight on while that stays within DELTA of the frames, a length or, as in 0.2r, a"
               " multiple of the smallest radius (default: none)"},
    OptionSpec{
        "--certify", "",
        "with a stride in --frames or --tolerance: read all frames, and bound what may have been missed"},
    OptionSpec{
        "--audit", "WHEN",
        "compare with static builds: none, frames or events, which takes 10 to 200 times as long as the "
        "run (default: none)"},
    OptionSpec{"--rounds", "N",
               "repeat the run N times and report the median time, with the least and most (default: 1)"},
    OptionSpec{"--work", "LIMIT",
               "end the run where exact arithmetic takes more limb operations than this (default: no limit)"},
    OptionSpec{"--dump", "DIR",
               "write the structures at every frame there, in place of an earlier dump (default: none)"},
    kEventsOption,
    OptionSpec{"--log", "FILE", "write the event log there, for kds replay (default: none)"},
    OptionSpec{
        "--out", "DIR",
        "write summary.json, events.csv, report.html and, of contacts, contacts.csv there (default: none)"},
    OptionSpec{"--json", "FILE", "write the summary there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr auto kAllRunOptions = joined(kInputOptions, joined(kObstacleOption, kRunOptions));

constexpr CommandSpec kRunCommand{
    "kds run",
    "Runs kinetic structures over moving beads and reports every event, exactly and in order.",
    kInputOperand,
    kInputHelp,
    kAllRunOptions,
    "kds run villin.dcd --topology villin.pdb --frames 0:200 --structures wrapped,power --out report\n"
    "kds run models.pdb --kernel exact --audit events --json -",
};

NodeSelection parse_nodes(const ParsedArguments& parsed) {
  constexpr std::uint64_t most = std::uint64_t{1} << 32U;
  NodeSelection nodes;
  if (const auto text = parsed.value("--levels")) {
    const auto [first, end] = parse_range("--levels", *text, most);
    nodes.first_level = static_cast<std::uint32_t>(first);
    nodes.last_level = static_cast<std::uint32_t>(end - 1);
  }
  if (const auto text = parsed.value("--nodes")) {
    const auto [first, end] = parse_range("--nodes", *text, text->ends_with(':') ? most : most - 1);
    nodes.beads = BeadRange{static_cast<BeadId>(first), static_cast<BeadId>(end - 1)};
  }
  return nodes;
}

MotionTolerance parse_tolerance(const std::string& text, FrameMotion motion) {
  if (motion != FrameMotion::linear)
    throw InputError(
        fmt::format("--tolerance: beads go straight on; expected --motion linear, not {}", name_of(motion)));
  MotionTolerance tolerance;
  tolerance.of_radius = text.ends_with('r');
  try {
    tolerance.amount = parse_real(
        "--tolerance", std::string_view(text).substr(0, text.size() - (tolerance.of_radius ? 1 : 0)),
        {0, 1e300, true});
  } catch (const InputError&) {
    throw InputError(fmt::format(
        "--tolerance: '{}' is neither a length, as in 0.4, nor a multiple of the smallest radius, as "
        "in 0.2r; expected a number above 0, at most 1e300",
        text));
  }
  return tolerance;
}

}  // namespace

RunOptions parse_run_options(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kRunCommand, arguments);
  InputOptions input = parse_input_options(parsed, kRunCommand.name);
  RunOptions options;
  options.inputs = std::move(input.inputs);
  options.reading = std::move(input.reading);
  options.radius = std::move(input.radius);
  options.obstacle = std::move(input.obstacle);
  if (const auto list = parsed.value("--structures")) options.structures = parse_structures(*list);
  options.motion = chosen<FrameMotion>(parsed, "--motion", frame_motion_names).value_or(options.motion);
  options.kernel = chosen<Kernel>(parsed, "--kernel", kernel_names).value_or(options.kernel);
  options.nodes = parse_nodes(parsed);
  if (const auto apart = parsed.value("--apart")) options.apart = parse_apart(*apart);
  options.between = chosen<Between>(parsed, "--between", between_names);
  if (const auto tightness = parsed.value("--tightness"))
    options.tightness = parse_real("--tightness", *tightness, {1e-6, 1});
  if (const auto relax = parsed.value("--relax"))
    options.relax = parse_real("--relax", *relax, {Relaxation::least_share, 1});
  if (const auto tolerance = parsed.value("--tolerance"))
    options.tolerance = parse_tolerance(*tolerance, options.motion);
  options.certify = parsed.has("--certify");
  refuse_needless_certificate(options);
  options.audit = chosen<AuditMode>(parsed, "--audit", audit_mode_names).value_or(options.audit);
  if (const auto rounds = parsed.value("--rounds"))
    options.rounds = parse_whole_number("--rounds", *rounds, 1, 1000);
  if (const auto limit = parsed.value("--work"))
    options.work = parse_whole_number("--work", *limit, 0, ExactWork::no_limit - 1);
  options.dump = path_of(parsed, "--dump");
  options.events = path_of(parsed, kEventsOption.name);
  options.log = path_of(parsed, "--log");
  options.out = path_of(parsed, "--out");
  options.json = parsed.value("--json");
  options.quiet = parsed.has("--quiet");
  return options;
}

}  // namespace kds
