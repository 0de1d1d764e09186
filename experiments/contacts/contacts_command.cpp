#include "experiments/contacts/contacts_command.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "experiments/contacts/contacts_report.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/option.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/radius_hint.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr CommandSpec kContactsCommand{
    "kds contacts",
    "Measures how long contacts last: exact intervals for each pair of residues, beads or chains, their "
    "survival function, and what a look at frames alone would have told.",
    {},
    {},
    "kds contacts villin.dcd --topology villin.pdb --cutoff 8 --select ca --out report\n"
    "kds contacts a.xyz --cutoff 4.5:6 --gap 2 --by bead --json -"};

ContactCutoffs parse_cutoffs(const std::string& text) {
  const std::vector<std::string> lengths = split(text, ':');
  if (lengths.size() > 2)
    throw InputError(
        fmt::format("--cutoff: '{}' has {} lengths; expected one, or two as in 4.5:6", text, lengths.size()));
  ContactCutoffs cutoffs;
  cutoffs.inner = parse_real("--cutoff", lengths.front(), {0, 1e9});
  cutoffs.outer = parse_real("--cutoff", lengths.back(), {0, 1e9});
  if (cutoffs.outer < cutoffs.inner)
    throw InputError(
        fmt::format("--cutoff: '{}' ends contacts within the distance at which they begin; expected "
                    "the smaller length first, {}:{}",
                    text, lengths.back(), lengths.front()));
  return cutoffs;
}

Option<ContactsTask> cutoff_option() {
  auto option = value_option(
      {"--cutoff", "LENGTH",
       "two beads are in contact while their centres are at most this far apart (must be given; 8 is usual "
       "between C-alpha atoms, 4.5 between heavy atoms). A:B are two cutoffs: a contact begins within A and "
       "ends "
       "outside B"},
      &ContactsTask::cutoff, parse_cutoffs, [](const ContactCutoffs& cutoffs) {
        return cutoffs.are_two() ? fmt::format("{}:{}", cutoffs.inner, cutoffs.outer)
                                 : fmt::format("{}", cutoffs.inner);
      });
  return option;
}

// Returns the options that appear as settings in the JSON.
const OptionList<ContactsTask>& contacts_task_options() {
  using O = ContactsTask;
  static const auto list =
      OptionList<O>()
          .with(input_options().with({obstacle_option()}))
          .with(
              {cutoff_option(),
               flag_option("--surface", "measure the cutoff between the surfaces of beads (default: centres)",
                           &O::surface),
               real_option(
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
                      "also tell what a look at every frame, every second, ... would tell (default: "
                      "1,2,4,8,16,32,64, as far as at least two frames remain)"},
                     &O::strides, parse_strides)),
                 whole_option(
                     {"--intermittency", "K",
                      "in the figures of frames, bridge absences of up to K frames looked at (default: 1)"},
                     &O::intermittency, 0, 1'000'000),
                 // Lifted motion is excluded because it has no radii between frames.
                 choice_option({"--motion", "NAME",
                                "motion of beads between frames: linear or hermite (default: linear)"},
                               &O::motion, std::span(frame_motion_names).first(2))});
  return list;
}

void warn_of_none(const ContactsTask& task, const Scene& scene, const ContactsReport& report,
                  const TableCommand::Warn& warn) {
  std::string line = fmt::format("there are no contacts within --cutoff {}", task.cutoff->inner);
  // The hint looks at pairs of all beads.
  if (task.reading.groups.empty() && report.by != ContactElement::chain)
    if (const auto hint = cutoff_hint(scene, task.surface, report.apart)) line += "; " + *hint;
  warn(line);
}

}  // namespace

ContactsOptions parse_contacts_options(const Arguments& arguments) {
  using O = ContactsOptions;
  static const auto list =
      OptionList<O>()
          .with(&O::task, contacts_task_options())
          .with(&O::destinations,
                destination_options("write contacts.json, contacts.csv, intervals.csv, frames.csv "
                                    "and report.html to DIR (default: none)"));
  O options;
  const ParsedArguments parsed = read_arguments(with_inputs(kContactsCommand), list, arguments, options);
  take_inputs(parsed, kContactsCommand.name, options.task);
  const ContactsTask& task = options.task;
  if (!task.cutoff)
    throw InputError(
        "kds contacts needs --cutoff LENGTH, the distance within which two beads are in contact, such as "
        "--cutoff 8 "
        "between C-alpha atoms or --cutoff 4.5 between heavy atoms");
  if (task.cutoff->inner == 0 && !task.surface)
    throw InputError(
        "--cutoff: centres that coincide are no contact; expected a length above 0, or --surface");
  return options;
}

int contacts_command(const Arguments& arguments) {
  const ContactsOptions options = parse_contacts_options(arguments);
  const ContactsTask& task = options.task;
  TableCommand command("contacts", arguments, options.destinations, "step");
  check_inputs_exist(task);
  TakenPaths taken;
  taken.read(task);
  command.check_destinations(std::move(taken),
                             {"contacts.json", "contacts.csv", "intervals.csv", "frames.csv", "report.html"});

  if (const auto instance = read_lone_instance(task))
    throw InputError(instance->file + ": an instance file has points and one step; expected a trajectory");
  const TableCommand::Warn warn = command.warn();
  InputOptions loaded = task;
  if (!task.surface && task.radius == "auto")
    loaded.radius = "1";  // centres have contacts whatever the radii
  const Scene scene = load_necklaces(loaded, task.motion, 1, warn);
  const auto report = follow_contacts(task, scene, command.progress());
  const ContactsFigures figures = figures_of(*report);
  if (figures.all.contacts == 0) warn_of_none(task, scene, *report, warn);

  Json json;
  json["input"] = input_json(task,
                             {scene.bead_count(), scene.necklaces().size(), scene.frame_count(),
                              scene.dimension(), scene.is_truncated()},
                             scene.radii());
  json["settings"] = contacts_task_options().settings_json(task);
  add_contacts(*report, figures, json);
  json["warnings"] = command.warnings();
  TableCommand::Csvs csvs{{"contacts.csv", contacts_csv(*report, figures)},
                          {"frames.csv", frames_csv(*report)}};
  csvs.emplace_back("intervals.csv",
                    CsvContent([&](std::ostream& stream) { write_intervals_csv(*report, stream); }));
  command.deliver(json, csvs, contacts_text(*report, figures), [&](Page page) {
    return contacts_page(*report, figures, file_names(task), std::move(page));
  });
  return 0;
}

}  // namespace kds
