#include "experiments/run/run_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "certificates/exact/exact_work.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option_values.h"
#include "experiments/run/certify_stride.h"
#include "motions/base/input_error.h"
#include "motions/live/live_address.h"
#include "structures/session/structure_spec.h"

namespace kds {

std::string structures_help() {
  return fmt::format(
      "comma list of {} (default: wrapped,power; with an instance file: sorted in 1D, otherwise power)",
      words("structures (see kds help structures)", "kds.structure_names()"));
}

std::string structures_table(std::size_t width) {
  std::string text = wrapped(
      "Structures that --structures names. Net changes are what kds compare counts between two frames.\n",
      width, 0);
  for (const StructureSpec& spec : structure_registry().all())
    text += fmt::format(
        "\n  {:<10} {}", spec.name,
        wrapped(spec.about + (spec.net_changes.empty() ? "" : "; net changes: " + spec.net_changes), width,
                13));
  return text + '\n';
}

namespace {

constexpr CommandSpec kRunCommand{
    "kds run",
    "Runs kinetic structures over moving beads and reports every event, exactly and in order.",
    {},
    {},
    "kds run villin.dcd --topology villin.pdb --frames 0:200 --structures wrapped,power --out report\n"
    "kds run models.pdb --kernel exact --audit events --json -",
};

constexpr std::uint64_t most_ids = std::uint64_t{1} << 32U;

/// Returns the text FIRST:LAST, with LAST excluded, for the levels or beads from `first` to `last`; FIRST: if
/// the range has no end.
std::string range_text(std::uint64_t first, std::uint64_t last) {
  return last + 1 == most_ids ? fmt::format("{}:", first) : fmt::format("{}:{}", first, last + 1);
}

Option<RunOptions> levels_option() {
  return {
      {"--levels", "RANGE",
       "levels of wrapped, boxes and layered to keep: FIRST:LAST, counted from 0 at the roots; level LAST "
       "itself is not kept (default: all)"},

      [](RunOptions& o, const std::string& text) {
        const auto [first, end] = parse_range("--levels", text, most_ids);
        o.nodes.first_level = static_cast<std::uint32_t>(first);
        o.nodes.last_level = static_cast<std::uint32_t>(end - 1);
      },

      [](const RunOptions& o) {
        NodeSelection levels = o.nodes;
        levels.beads.reset();
        return levels.restricts() ? range_text(o.nodes.first_level, o.nodes.last_level) : "";
      }};
}

Option<RunOptions> nodes_option() {
  return {{"--nodes", "RANGE",
           "nodes of wrapped, boxes and layered to keep: those with all their beads in the range FIRST:LAST, "
           "counted from 0; bead LAST itself is not in it (default: all)"},

          [](RunOptions& o, const std::string& text) {
            const auto [first, end] =
                parse_range("--nodes", text, text.ends_with(':') ? most_ids : most_ids - 1);
            o.nodes.beads = BeadRange{static_cast<BeadId>(first), static_cast<BeadId>(end - 1)};
          },

          [](const RunOptions& o) {
            return o.nodes.beads ? range_text(o.nodes.beads->first, o.nodes.beads->last) : "";
          }};
}

MotionTolerance parse_tolerance(const std::string& text, FrameMotion motion) {
  if (motion != FrameMotion::linear)
    throw InputError("--tolerance", fmt::format("beads go straight on; expected {} linear, not {}",
                                                "--motion"_arg, name_of(motion)));
  MotionTolerance tolerance;
  tolerance.of_radius = text.ends_with('r');
  try {
    tolerance.amount = parse_real(
        "--tolerance", std::string_view(text).substr(0, text.size() - (tolerance.of_radius ? 1 : 0)),
        {0, 1e300, true});
  } catch (const InputError&) {
    throw InputError("--tolerance",
                     fmt::format("'{}' is neither a length, as in 0.4, nor a multiple of the smallest "
                                 "radius, as in 0.2r; expected a number above 0, at most 1e300",
                                 text));
  }
  return tolerance;
}

Option<RunOptions> tolerance_option() {
  return {
      {"--tolerance", "DELTA",
       "straighten paths: beads move straight over several frames and stay within DELTA of their positions "
       "in every frame; a length or, as in 0.2r, a multiple of the smallest radius (default: none)"},
      [](RunOptions& o, const std::string& text) { o.tolerance = parse_tolerance(text, o.motion); },
      [](const RunOptions& o) { return o.tolerance ? o.tolerance->text() : ""; }};
}

Option<RunOptions> structures_option() {
  static const std::string help = structures_help();
  return {{"--structures", "LIST", help},
          [](RunOptions& o, const std::string& text) { o.structures = parse_structures(text); },
          [](const RunOptions& o) { return fmt::format("{}", fmt::join(o.structures, ",")); }};
}

/// Returns the option --probe. Its default value appears as a setting, unless it is 0.
Option<RunOptions> probe_option_of_run() {
  auto option = probe_option(&RunOptions::probe);
  option.text = [](const RunOptions& o) {
    return o.probe || o.probe_length() > 0 ? fmt::format("{}", o.probe_length()) : "";
  };
  return only_for({"power", "dual", "voids"}, option);
}

/// Returns the option --rounds. The default value of the option does not appear as a setting.
Option<RunOptions> rounds_option() {
  auto option = whole_option(
      {"--rounds", "N",
       "repeat the run N times and report the median time, and the shortest and longest (default: 1)"},
      &RunOptions::rounds, 1, 1000);
  option.text = [](const RunOptions& o) { return o.rounds > 1 ? std::to_string(o.rounds) : ""; };
  return option;
}

}  // namespace

OptionList<Destinations> run_destination_options() {
  return destination_options(
      "write summary.json, events.csv, report.html and, for contacts, contacts.csv (with --certify also "
      "possible_contacts.csv) to DIR (default: none)",
      "write the summary to FILE; - is standard output (default: none)");
}

const OptionList<RunOptions>& motion_and_structure_options() {
  using O = RunOptions;
  static const std::string motion_help = fmt::format("motion of beads between frames: {} (default: linear)",
                                                     fmt::join(frame_motion_names, ", "));
  static const OptionList<O> list =
      OptionList<O>()
          .with(input_options().with({obstacle_option(), velocities_option()}))
          .with({
              structures_option(),
              choice_option({"--motion", "NAME", motion_help}, &O::motion, frame_motion_names),
              choice_option({"--kernel", "NAME", "arithmetic: filtered or exact (default: filtered)"},
                            &O::kernel, kernel_names),
              only_for({"wrapped", "boxes", "layered"}, levels_option()),
              only_for({"wrapped", "boxes", "layered"}, nodes_option()),
              only_for(
                  {"wrapped"},
                  choice_option({"--between", "NAME",
                                 "spheres of wrapped between frames. events: the smallest sphere at every "
                                 "moment; chord: interpolated between the frames, faster, without events "
                                 "(default: events)"},
                                &O::between, between_names)),
              real_option({"--tightness", "EPS",
                           fmt::format("with {} chord: keep radii within 1 + EPS times the smallest, "
                                       "splitting a node's step where needed (default: none)",
                                       "--between"_arg)},
                          &O::tightness, {1e-6, 1}),
              only_for(
                  {"contacts"},
                  apart_option(
                      "contacts: pairs of beads of one chain must be at least K apart along it (default: 2)",
                      &O::apart)),
          })
          .with(&O::distances,
                contact_options("contacts: two beads are in contact while their centres are at most this far "
                                "apart (default: while their balls meet)"))
          .with(OptionList<InputOptions>({only_for({"contacts"}, groups_option())}))
          .with({
              only_for({"boxes"}, directions_option(&O::directions)),
              only_for({"spanner"}, stretch_option(&O::stretch)),
              probe_option_of_run(),
              tolerance_option(),
          });
  return list;
}

const OptionList<RunOptions>& run_options() {
  using O = RunOptions;
  static const OptionList<O> list =
      motion_and_structure_options()
          .with(live_options())
          .with({
              flag_option("--certify",
                          fmt::format("with a stride in {}, or with {}: read all frames too, and report the "
                                      "largest possible error of the run",
                                      frames_argument(), "--tolerance"_arg),
                          &O::certify),
              choice_option({"--audit", "WHEN",
                             "check against structures built from scratch: none, frames (at all frames) or "
                             "events (also between all events; 10 to 200 times slower) (default: none)"},
                            &O::audit, audit_mode_names),
              rounds_option(),
              threads_option(&O::threads),
              of_output(whole_option(
                  {"--work", "LIMIT",
                   "stop after LIMIT units (limb operations) of exact arithmetic (default: no limit)"},
                  &O::work, 0, ExactWork::no_limit - 1)),
              of_output(path_option(
                  {"--dump", "DIR", "write the structures at every frame to DIR (default: none)"}, &O::dump)),
              events_option(&O::events),
              of_output(path_option(
                  {"--log", "FILE", "write the event log to FILE, for kds replay (default: none)"}, &O::log)),
              view_option(&O::view),
          })
          .with(run_destination_options())
          .with(live_output_options());
  return list;
}

RunOptions parse_run_options(const Arguments& arguments) {
  RunOptions options;
  const ParsedArguments parsed =
      read_arguments(with_inputs(kRunCommand, true, true), run_options(), arguments, options);
  take_inputs(parsed, kRunCommand.name, options);
  options.takes_live = true;
  options.distances.check();
  if (options.certify && !options.tolerance)
    refuse_needless_certificate(options, ", or " + "--tolerance"_arg);
  check_live_output(options, options, options);
  refuse_if_live(options, options.rounds > 1, "--rounds", "a simulation runs once; expected 1");
  refuse_if_live(options, options.certify, "--certify",
                 "reads all frames again; expected a trajectory that the simulation has written");
  for (const auto& [name, path] : {std::pair("--log", &options.log), std::pair("--view", &options.view)})
    refuse_if_live(
        options, path->has_value(), name,
        "needs all frames before the run; expected a trajectory that the simulation has written, or "
        "--events FILE");
  return options;
}

Arguments repeating_arguments(const RunOptions& options) {
  Arguments arguments;
  for (const auto& input : options.inputs)
    arguments.push_back((is_live_address(input) ? input : std::filesystem::absolute(input)).string());
  const Arguments settings = run_options().arguments(options);
  arguments.insert(arguments.end(), settings.begin(), settings.end());
  return arguments;
}

}  // namespace kds
