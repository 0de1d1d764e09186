#include "experiments/trade/trade_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "experiments/output/output_files.h"
#include "experiments/output/text.h"
#include "experiments/program/command_line.h"
#include "experiments/program/commands.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/radius_hint.h"
#include "experiments/trade/measure_trade.h"
#include "experiments/trade/trade_report.h"
#include "kds/stopwatch.h"
#include "motions/base/input_error.h"
#include "motions/scene/radii.h"

namespace kds {

namespace {

struct TradeOptions : InputOptions, Destinations {
  TradeTask task;
};

constexpr CommandSpec kTradeCommand{
    "kds trade",
    "Compares options that trade accuracy for speed with the exact run: time saved, errors made.\n\n"
    "The table has a row for each setting and some of these columns. A group begins with its exact run. "
    "Errors are\n"
    "measured at frames and at random times between them. The truth is straight motion between all "
    "frames.\n\n"
    "  *                           no other row of the group is both as fast and as accurate\n"
    "  seconds                     processor time, median of the rounds, without reading and the first "
    "build\n"
    "  ratio                       seconds / seconds of the exact run for as many frames\n"
    "  tests                       tests of two spheres by a search for contacts in the hierarchy, on "
    "average\n"
    "  radius, at most, at frames  how much larger spheres are than the smallest: mean, maximum, maximum "
    "over "
    "frames\n"
    "  outside                     beads outside their spheres, on average\n"
    "  wrong, edges                cells that are not in the true diagram, short edges that are missed\n"
    "  missed                      true events or contacts that the run does not have\n"
    "  invented, spurious          events or contacts of the run that are not true\n"
    "  unsure                      contacts that are possible but not certain\n"
    "  time, at most               error of times, in frames: mean, maximum\n"
    "  closest, moved              largest error of the closest distance; largest distance of a bead from "
    "its true position",
    {},
    {},
    "kds trade villin.dcd --topology villin.pdb --frames 0:200 --out report\n"
    "kds trade villin.dcd --topology villin.pdb --want contacts --radius 2 --apart 5\n"
    "kds trade models.pdb --chain A,B --want scenes",
};

std::vector<Want> parse_wants(const std::string& list) {
  std::vector<Want> wants;
  for (const std::string& word : split(list, ',')) {
    wants.push_back(choice_of<Want>("--want", word, want_names));
    if (std::count(wants.begin(), wants.end(), wants.back()) > 1)
      throw InputError("--want", fmt::format("{} is listed twice", word));
  }
  std::sort(wants.begin(), wants.end());
  return wants;
}

Option<TradeTask> without_exact_option() {
  Option<TradeTask> option(
      {"--without-exact", "",
       fmt::format(
           "leave out {} exact, which is a hundred to thousands of times slower and has the same events",
           "--kernel"_arg)},
      [](TradeTask& task, const std::string&) { task.exact_kernel = false; },
      [](const TradeTask& task) { return task.exact_kernel ? "" : "yes"; }, nullptr,
      [](const TradeTask& task) { return Json(task.exact_kernel); });
  option.setting = "exact_kernel";
  return option;
}

/// The options that say what is measured. --cutoff is not a setting in the JSON.
const OptionList<TradeTask>& task_options() {
  using O = TradeTask;
  static const auto list =
      OptionList<O>()
          .with(
              {list_option(
                   {"--want", "LIST",
                    "comma list of what you need: contacts, cages (bounding spheres), diagram, events; "
                    "scenes measures only what each structure costs (default: contacts,cages,diagram)"},
                   &O::wants, parse_wants),
               only_for(
                   {"contacts", "events", "scenes"},
                   apart_option(
                       "contacts: pairs of beads of one chain must be at least K apart along it (default: 2)",
                       &O::apart)),
               only_for({"diagram", "events"},
                        of_output(
                            real_option({"--cutoff", "LENGTH",
                                         "diagram: count missed edges that are shorter than LENGTH (default: "
                                         "4 times the largest radius)"},
                                        &O::cutoff, {0, 1e300, true}))),
               only_for({"contacts", "cages", "diagram", "events"}, without_exact_option()),
               whole_option(
                   {"--rounds", "N",
                    "run each setting N times, alternating, and report the median time (default: 5)"},
                   &O::rounds, 1, 1000)})
          .with(&O::sampling,
                {{only_for({"contacts", "cages", "diagram", "events"},
                           whole_option({"--times", "N",
                                         "number of random times, and of frames, at which errors are "
                                         "measured (default: 200)"},
                                        &SamplingOfTimes::times, 1, 1'000'000)),
                  only_for({"contacts", "cages", "diagram", "events"},
                           whole_option({"--seed", "N", "seed of the random times (default: 1)"},
                                        &SamplingOfTimes::seed, 0, ~std::uint64_t{0}))}})
          .with({threads_option(&O::threads)});
  return list;
}

const OptionList<TradeOptions>& trade_options() {
  using O = TradeOptions;
  static const auto list =
      OptionList<O>()
          .with(input_options())
          .with(&O::task, task_options())
          .with(OptionList<InputOptions>({only_for(
              {"contacts", "events", "scenes"},
              groups_option(fmt::format(
                  "contacts: one bead of a pair must be in SEL1 and the other in SEL2, each as {} takes it, "
                  "among the beads that are read; leaves out settings with {} ca (default: all pairs)",
                  "--select"_arg, "--select"_arg)))}))
          .with(destination_options("write trade.json, trade.csv and report.html to DIR (default: none)",
                                    "write the rows to FILE; - is standard output (default: none)",
                                    "print no table and no progress bar; the bar counts runs: one of each "
                                    "setting for its errors, then the rounds"));
  return list;
}

// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
// --help. Opens no file.
TradeOptions parse_trade_options(const Arguments& arguments) {
  TradeOptions options;
  const ParsedArguments parsed =
      read_arguments(with_inputs(kTradeCommand), trade_options(), arguments, options);
  take_inputs(parsed, kTradeCommand.name, options);
  std::vector<std::string> wants;
  for (const Want want : options.task.wants) wants.emplace_back(name_of(want));
  trade_options().refuse_needless(wants, fmt::format("in {}", "--want"_arg),
                                  [&](const auto& option) { return parsed.has(option.spec.name); });
  return options;
}

// The decision depends only on the numbers of beads and frames, so that every machine has the same rows.
bool leave_out_exact_kernel(const FinestData& finest, const TradeTask& task,
                            const std::function<void(const std::string&)>& warn) {
  constexpr std::size_t most_beads = 500, most = 50'000;
  const bool asked_for = task.exact_kernel;
  if (task.wants == std::vector{Want::scenes}) return true;  // scenes have no kernel variants
  const std::size_t beads = finest.radii().size(), frames = finest.frame_count();
  if (beads <= most_beads && beads * frames <= most) return !asked_for;
  if (!asked_for) return true;
  warn(
      fmt::format("`{} exact` is left out: {} beads in {} frames would take too long; expected no more than "
                  "{} beads, and no more than {} times frames",
                  "--kernel"_arg, beads, frames, most_beads, most));
  return true;
}

// Estimates the time for all frames from a full measurement of the first frames. Throws InputError if the
// first frames alone do not fit what is wanted.
double foretold_by_first_frames(const FinestData& finest, const TradeTask& task) {
  constexpr std::size_t few = 9;
  if (finest.frame_count() <= 2 * few) return 0;
  TradeTask pilot = task;
  pilot.rounds = 1;
  pilot.sampling.times = 4;
  const FinestData first = finest.first_frames(few);
  // Two measurements separate the cost of examining a time from the cost of a run.
  const auto try_out = [&] {
    static_cast<void>(measure_trade(
        first, pilot, [](auto, auto) {}, [](auto&) {}));
  };
  const double with_few = seconds_of<WallClock>(try_out);
  pilot.sampling.times = 8;
  const double with_more = seconds_of<WallClock>(try_out);
  const double a_look = std::max(0.0, with_more - with_few) / 4;
  const double a_round = std::max(0.0, with_few - 4 * a_look) / 2;
  const double steps = static_cast<double>(finest.frame_count() - 1) / (few - 1);
  // Number of random times; also the number of frames examined, if there are as many.
  const std::size_t times = task.sampling.times;
  return a_look * 0.5 * static_cast<double>(times + std::min(times, finest.frame_count())) +
         a_round * steps * static_cast<double>(task.rounds + 1);
}

// Returns 0 if the time cannot be estimated.
double foretold_seconds(const FinestData& finest, const TradeTask& task) {
  try {
    return foretold_by_first_frames(finest, task);
  } catch (const InputError&) {
    return 0;
  }
}

void foretell(double seconds) {
  if (seconds < 5) return;
  std::fputs(seconds < 120 ? fmt::format("kds: about {:.0f} seconds\n", seconds).c_str()
                           : fmt::format("kds: about {:.0f} minutes\n", seconds / 60).c_str(),
             stderr);
}

// Reads all frames of all inputs.
std::vector<Trajectory> read_necklaces(const TradeOptions& options,
                                       const std::function<void(const std::string&)>& warn) {
  const std::unique_ptr<FileFrames> files = open_frames(options, warn);
  std::vector<std::vector<Eigen::Matrix3Xd>> frames(files->necklaces().size());
  std::vector<std::size_t> numbers;
  std::vector<double> times;
  bool has_cell = false;
  for (FrameRead frame; files->next(frame);) {
    has_cell = has_cell || frame.cell;
    numbers.push_back(frame.stamp.number);
    if (frame.stamp.picoseconds) times.push_back(*frame.stamp.picoseconds);
    Eigen::Index begin = 0;
    for (std::size_t n = 0; n < frames.size(); ++n) {
      const auto beads = static_cast<Eigen::Index>(files->necklaces()[n].count);
      if (frames[n].empty() || !files->necklaces()[n].at_rest)
        frames[n].emplace_back(frame.positions.middleCols(begin, beads));
      begin += beads;
    }
  }
  for (const std::string& warning : files->warnings()) warn(warning);
  if (has_cell && options.periodic) warn_of_images("trade", warn);
  if (times.size() < numbers.size()) times.clear();
  std::vector<Trajectory> necklaces = files->heads();  // complete now that all frames have been read
  for (std::size_t n = 0; n < necklaces.size(); ++n) {
    necklaces[n].frames = std::move(frames[n]);
    necklaces[n].truncated = files->is_truncated();
    if (files->necklaces()[n].at_rest) continue;
    necklaces[n].frame_numbers = numbers;
    necklaces[n].times = times;
  }
  return necklaces;
}

void refuse_lone_frame(const TradeOptions& options, const std::vector<Trajectory>& necklaces) {
  const FrameRange& frames = options.reading.frames;
  const bool all = frames.first == 0 && !frames.last && frames.stride == 1;
  const bool lone = std::all_of(necklaces.begin(), necklaces.end(),
                                [](const Trajectory& necklace) { return necklace.frames.size() < 2; });
  if (!all && lone)
    throw InputError(fmt::format("{} {}: leaves 1 frame of {}; expected a range of two or more",
                                 frames_argument(), name_of(frames), necklaces.front().file));
}

// The input, and the measurements that the options ask for.
struct TradeSubject {
  FinestData finest;
  TradeTask task;
};

TradeSubject read_subject(const TradeOptions& options, const std::function<void(const std::string&)>& warn) {
  refuse_instance(options);
  std::vector<Trajectory> necklaces = read_necklaces(options, warn);
  refuse_lone_frame(options, necklaces);
  std::vector<double> radii = bead_radii(options.radius, necklaces);
  TradeSubject subject{FinestData(std::move(necklaces), std::move(radii), options.radius), options.task};
  subject.task.frames = options.reading.frames;
  subject.task.exact_kernel = !leave_out_exact_kernel(subject.finest, subject.task, warn);
  return subject;
}

std::vector<TradeRow> measure_subject(const TradeOptions& options, const TradeSubject& subject,
                                      const std::function<void(std::size_t, std::size_t)>& progress,
                                      const std::function<void(const std::string&)>& warn) {
  hint_at_threads(subject.task.threads, subject.finest.frame_count() - 1, subject.finest.radii().size(),
                  warn);
  std::vector<TradeRow> rows = measure_trade(subject.finest, subject.task, progress, warn);
  const bool no_contacts = std::ranges::any_of(rows, [](const TradeRow& row) {
    return row.want == Want::contacts && row.is_exact && row.cost.events == 0;
  });
  if (no_contacts && options.radius == "auto" && options.reading.groups.empty())
    if (const auto hint = radius_hint(subject.finest.scene(), subject.task.apart)) warn(*hint);
  return rows;
}

}  // namespace

std::vector<TradeRow> measure_trade_of(const Arguments& arguments,
                                       const std::function<void(std::size_t, std::size_t)>& progress,
                                       const std::function<void(const std::string&)>& warn) {
  const TradeOptions options = parse_trade_options(arguments);
  return measure_subject(options, read_subject(options, warn), progress, warn);
}

int trade_command(const Arguments& arguments) {
  const TradeOptions options = parse_trade_options(arguments);
  TableCommand command("trade", arguments, options, "run");
  command.check_inputs_and_destinations(options);

  const TradeSubject subject = read_subject(options, command.warn());
  const FinestData& finest = subject.finest;
  const TradeTask& task = subject.task;
  if (!options.quiet) foretell(foretold_seconds(finest, task));
  const std::vector<TradeRow> rows = measure_subject(options, subject, command.progress(), command.warn());

  Json json;
  InputSize size = size_of(finest.scene());
  size.frames = finest.frame_count();
  size.ends[1] = finest.scene().stamp(finest.frame_count() - 1);
  json["input"] = input_json(options, size, finest.radii());
  json["settings"] = trade_options().settings_json(options);
  json["rows"] = trade_rows_json(rows);
  json["recommendation"] = recommendation(rows);
  json["recommendations"] = recommendations_json(rows);
  json["warnings"] = command.warnings();
  command.deliver(json, trade_csv(rows), trade_table(rows));
  return 0;
}

}  // namespace kds
