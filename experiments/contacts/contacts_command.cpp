#include "experiments/contacts/contacts_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "experiments/contacts/contacts_report.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/option.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/run/certify_stride.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/page_of_run.h"
#include "experiments/run/radius_hint.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr CommandSpec kContactsCommand{
    "kds contacts",
    "Measures how long contacts last, exactly for the paths between the frames that are given; the spacing "
    "of frames is the error. Gives intervals for each pair of residues, beads or chains, their survival "
    "function, and what frames alone would have shown.",
    {},
    {},
    "kds contacts villin.dcd --topology villin.pdb --cutoff 8 --select ca --out report\n"
    "kds contacts a.xyz --cutoff 4.5:6 --gap 2 --by bead --json -"};

// Returns the options that appear as settings in the JSON.
const OptionList<ContactsTask>& contacts_task_options() {
  using O = ContactsTask;
  static const auto list =
      OptionList<O>()
          .with(input_options().with({obstacle_option(), velocities_option()}))
          .with(live_options())
          .with(&O::distances,
                contact_options(
                    "two beads are in contact while their centres are at most this far apart (must be given; "
                    "8 is usual between C-alpha atoms, 4.5 between heavy atoms). A:B are two cutoffs: a "
                    "contact begins when the least distance of two beads of the pair falls to A, and ends "
                    "when it exceeds B",
                    ':'))
          .with(
              {real_option(
                   {"--gap", "TIME",
                    "an absence shorter than this does not end a contact; in picoseconds if the frames have "
                    "times, otherwise in frames (default: 0)"},
                   &O::gap, {0, 1e12}),
               choice_option(
                   {"--by", "NAME",
                    "count contacts between elements of this kind: bead, residue or chain. Two elements "
                    "are in contact while any two of their beads are (default: residue if the input names "
                    "residues, otherwise bead)"},
                   &O::by, std::span(contact_element_names)),
               apart_option("elements of one chain must be at least K apart along it (default: 3)",
                            &O::apart)})
          .with(OptionList<InputOptions>({groups_option()}))
          .with({of_output(list_option(
                     {"--strides", "LIST",
                      "also report what every frame, every second frame, ... would show (default: "
                      "1,2,4,8,16,32,64, as far as at least two frames remain)"},
                     &O::strides, parse_strides)),
                 whole_option({"--intermittency", "K",
                               "in the figures of samples, bridge absences of up to K samples (default: 1)"},
                              &O::intermittency, 0, 1'000'000),
                 // Lifted motion is excluded because it has no radii between frames.
                 choice_option({"--motion", "NAME",
                                "motion of beads between frames: linear or hermite (default: linear)"},
                               &O::motion, std::span(frame_motion_names).first(2)),
                 flag_option("--certify",
                             fmt::format("with a stride in {}: read all frames too, and report which "
                                         "contacts are sure, and bounds of the time in contact",
                                         frames_argument()),
                             &O::certify),
                 threads_option(&O::threads)});
  return list;
}

void warn_of_none(const ContactsTask& task, const Scene& scene, const ContactsReport& report,
                  const TableCommand::Warn& warn) {
  if (report.pairs_asked == 0)
    return warn(fmt::format(
        "there are no contacts, because none of {} {}s are a pair; {} is {}{}", report.elements.names.size(),
        name_of(report.by), "--apart"_arg, report.apart,
        task.reading.groups.empty() ? "" : fmt::format(", and {} leaves out pairs", "--groups"_arg)));
  std::string line =
      fmt::format("there are no contacts within {} {}", "--cutoff"_arg, task.distances.lengths.front());
  // The hint looks at pairs of all beads.
  if (task.reading.groups.empty() && report.by != ContactElement::chain)
    if (const auto hint = cutoff_hint(scene, task.distances.between_surfaces, report.apart))
      line += "; " + *hint;
  warn(line);
}

/// Returns the options with which the input is read. Centres have contacts whatever the radii, so `auto` is
/// not computed for them.
InputOptions options_of_input(const ContactsTask& task) {
  InputOptions options = task;
  if (!task.distances.between_surfaces && task.radius == "auto") options.radius = "1";
  return options;
}

/// Returns the least distance along a chain, in beads, of two beads whose elements are a pair of the task.
BeadId beads_apart(const Scene& scene, const ContactsReport& report) {
  auto least = static_cast<BeadId>(scene.bead_count());  // no two beads of a chain are as far apart
  if (report.by == ContactElement::chain) return least;
  const ContactElements& elements = report.elements;
  std::vector<BeadId> first(elements.names.size(), least), last(elements.names.size());
  for (BeadId bead = 0; bead < elements.of_bead.size(); ++bead) {
    const std::uint32_t element = elements.of_bead[bead];
    first[element] = std::min(first[element], bead);
    last[element] = bead;
  }
  for (std::size_t e = 0; e + report.apart < first.size(); ++e)
    if (elements.chains[e] == elements.chains[e + report.apart])
      least = std::min(least, first[e + report.apart] - last[e]);
  return least;
}

/// Returns the run whose contacts are followed, within the inner cutoff, before elements and gaps are looked
/// at. If elements have several beads, some pairs are of elements that are closer along a chain than the task
/// asks.
RunOptions run_to_show(const ContactsTask& task, const Scene& scene, const ContactsReport& report) {
  RunOptions run;
  static_cast<InputOptions&>(run) = options_of_input(task);
  run.structures = {"contacts"};
  run.motion = task.motion;
  run.apart = beads_apart(scene, report);
  run.distances = {{task.distances.lengths.front()}, task.distances.between_surfaces};
  return run;
}

}  // namespace

ContactsOptions parse_contacts_options(const Arguments& arguments) {
  using O = ContactsOptions;
  static const auto list =
      OptionList<O>()
          .with(&O::task, contacts_task_options())
          .with(&O::destinations,
                destination_options("write contacts.json, contacts.csv, intervals.csv, frames.csv, "
                                    "report.html and, with --certify, possible_intervals.csv to DIR "
                                    "(default: none)"))
          .with(
              {view_option(&O::view,
                           "run once more, and write a page that shows the contacts of beads in a browser to "
                           "FILE (default: none)")})
          .with(&O::live, live_output_options());
  O options;
  const ParsedArguments parsed =
      read_arguments(with_inputs(kContactsCommand, false, true), list, arguments, options);
  take_inputs(parsed, kContactsCommand.name, options.task);
  options.task.takes_live = true;
  const ContactsTask& task = options.task;
  if (task.distances.lengths.empty())
    throw InputError(
        "kds contacts needs --cutoff LENGTH, the distance within which two beads are in contact, such as "
        "--cutoff 8 "
        "between C-alpha atoms or --cutoff 4.5 between heavy atoms");
  task.distances.check();
  if (task.certify) refuse_needless_certificate(task);
  check_live_output(options.live, task, options.destinations);
  refuse_if_live(task,
                 task.by == ContactElement::residue && !task.reading.topology && task.topologies.empty(),
                 "--by", "residue: a simulation names no residues; expected a topology, or bead");
  for (const auto& [name, is_given] :
       {std::pair("--certify", task.certify), std::pair("--view", options.view.has_value())})
    refuse_if_live(task, is_given, name,
                   "reads all frames again; expected a trajectory that the simulation has written");
  return options;
}

ContactsFound find_contacts(const ContactsTask& task,
                            const std::function<void(std::size_t, std::size_t)>& progress,
                            const std::function<void(const std::string&)>& warn,
                            const MakeHooks& hooks_over) {
  refuse_instance(task, "points and one step");
  ContactsFound found;
  found.scene = std::make_unique<const Scene>(load_necklaces(options_of_input(task), task.motion, 1, warn));
  warn_of_cells("contacts", found.scene->lacks_images(), options_of_input(task), warn);
  const Scene& scene = *found.scene;
  if (scene.is_live()) {
    warn_of_threads(task.threads, warn);
    found.report =
        follow_contacts(task, scene, progress, hooks_over ? hooks_over(scene) : LiveHooks<ContactsReport>{});
    for (const std::string& line : scene.live_warnings()) warn(line);
    for (const std::size_t stride : task.strides)
      if (stride > scene.step_count())
        warn(fmt::format("{}: {} is left out, because it looks at one of the {} frames", "--strides"_arg,
                         stride, scene.frame_count()));
  } else {
    hint_at_threads(task.threads, scene.step_count(), scene.bead_count(), warn);
    found.report = follow_contacts(task, scene, progress);
  }
  const std::optional<CrossingCounts>& crossings = found.report->crossings;
  if (crossings && crossings->any()) warn(crossings->sentence());
  found.figures = figures_of(*found.report);
  if (task.certify) found.figures.certificate = certify_contacts(task, *found.scene, *found.report, progress);
  if (found.figures.all.contacts == 0) warn_of_none(task, *found.scene, *found.report, warn);
  return found;
}

namespace {

/// Delivers the final results or, unless `is_complete`, the results so far. Returns what `deliver_so_far`
/// returns.
std::optional<std::string> deliver(const ContactsOptions& options, const Scene& scene,
                                   const ContactsReport& report, const ContactsFigures& figures,
                                   bool is_complete, TableCommand& command) {
  InputSize size = size_of(scene);
  size.frames = report.steps + 1;
  size.ends[1] = scene.stamp(report.steps);
  Json json;
  json["input"] = input_json(options.task, size, scene.radii());
  json["settings"] = contacts_task_options().settings_json(options.task);
  if (report.live) add_live(json, *report.live);
  add_contacts(report, figures, json);
  json["warnings"] = command.warnings();
  TableCommand::Csvs csvs{{"contacts.csv", contacts_csv(report, figures)},
                          {"frames.csv", frames_csv(report)}};
  csvs.emplace_back("intervals.csv",
                    CsvContent([&](std::ostream& stream) { write_intervals_csv(report, figures, stream); }));
  if (figures.certificate)
    csvs.emplace_back("possible_intervals.csv", CsvContent([&](std::ostream& stream) {
                        write_possible_csv(report, *figures.certificate, stream);
                      }));
  if (!is_complete) return command.deliver_so_far(json, csvs);
  command.deliver(json, csvs, contacts_text(report, figures));
  return std::nullopt;
}

}  // namespace

int contacts_command(const Arguments& arguments) {
  ContactsOptions options = parse_contacts_options(arguments);
  const ContactsTask& task = options.task;
  std::optional<std::string> part;
  if (options.live.continues)
    part = start_part("contacts.json", contacts_task_options().settings_json(task), options.destinations);
  TableCommand command("contacts", arguments, options.destinations, "step");
  check_inputs_exist(task);
  const SignalsEndLiveInput on_signal(task);
  TakenPaths taken;
  taken.read(task);
  if (options.view) taken.write_page(*options.view, options.destinations);
  command.check_destinations(std::move(taken));
  if (part) print_note(command.bar(), *part);
  options.task.reading.on_wait = waiting_note(command.bar(), task);

  ResultsSoFar regularly(command.bar(), options.live.every);
  const auto hooks_over = [&](const Scene& live_scene) {
    static_cast<void>(command.warnings());  // printed before the long wait
    const auto write = [&](const ContactsReport& report) {
      return deliver(options, live_scene, report, figures_of(report), false, command);
    };
    return regularly.hooks<ContactsReport>(options.destinations.out.has_value(), write);
  };
  const ContactsFound found = find_contacts(task, command.progress(), command.warn(), hooks_over);
  const Scene& scene = *found.scene;
  if (options.view)
    write_page_of_run(run_to_show(task, scene, *found.report), scene, *options.view,
                      command.add_replay(*options.view), command.progress());
  static_cast<void>(deliver(options, scene, *found.report, found.figures, true, command));
  return found.report->live ? end_of_live_run(command.bar(), *found.report->live, scene.is_truncated()) : 0;
}

}  // namespace kds
