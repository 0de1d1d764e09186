#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/bench/benches.h"
#include "experiments/bench/collision_peers.h"
#include "experiments/bench/subject.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "motions/base/input_error.h"
#include "motions/readers/reader_registry.h"

namespace kds {

namespace {

class CountedTurns final : public bench::Turns {
 public:
  explicit CountedTurns(std::size_t rounds) : left_(rounds) {}

  bool another() override { return left_-- > 0; }
  void took(double) override {}
  void note(std::string_view figure, double value) override { figures_[std::string(figure)] = value; }

  [[nodiscard]] std::optional<double> figure(const std::string& name) const {
    const auto found = figures_.find(name);
    return found == figures_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::size_t left_;
  std::map<std::string, double> figures_;
};

// Returns the row with the spread of its value, which the figures NAME_least and NAME_most hold.
BenchRow with_spread_of(BenchRow row, const CountedTurns& turns, const std::string& name) {
  row.spread = Spread{row.value, *turns.figure(name + "_least"), *turns.figure(name + "_most")};
  return row;
}

template <class AddRows>
std::vector<BenchRow> rows_of(const std::vector<bench::Subject>& subjects, std::size_t rounds,
                              const std::function<void(std::size_t, std::size_t)>& progress,
                              const AddRows& add_rows) {
  std::vector<BenchRow> rows;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    CountedTurns turns(rounds);
    subjects[i].run(turns);
    add_rows(subjects[i], turns, rows);
    progress(i + 1, subjects.size());
  }
  return rows;
}

void add_row_beside_peer(const bench::Subject& subject, const CountedTurns& turns,
                         std::vector<BenchRow>& rows) {
  const auto peer = turns.figure("peer_ns");
  rows.push_back(with_spread_of(
      {subject.name, subject.input, subject.beads, *turns.figure("ns"), "ns", peer ? subject.peer : "", peer,
       subject.most_ns ? subject.most_ns : subject.most_ratio, subject.most_ns.has_value()},
      turns, "ns"));
}

void check_folder(const std::filesystem::path& instances) {
  std::error_code error;
  if (!std::filesystem::is_directory(instances, error))
    throw InputError("--instances: " + instances.string() + ": expected a folder of moving-point files");
}

}  // namespace

std::vector<BenchRow> bench_certificates(const SubjectBenchOptions& options,
                                         const std::function<void(std::size_t, std::size_t)>& progress) {
  check_folder(options.instances);
  std::vector<bench::Subject> subjects = bench::certificate_subjects(options.instances);
  for (bench::Subject& subject : bench::slack_subjects()) subjects.push_back(std::move(subject));
  return rows_of(subjects, options.rounds, progress, add_row_beside_peer);
}

std::vector<BenchRow> bench_engine(const SubjectBenchOptions& options,
                                   const std::function<void(std::size_t, std::size_t)>& progress) {
  check_folder(options.instances);
  std::vector<bench::Subject> subjects = bench::engine_subjects(options.instances);
  if (subjects.empty())
    throw InputError("--instances: " + options.instances.string() +
                     ": expected files such as d3_n200_linear.txt");
  for (bench::Subject& subject : bench::queue_subjects()) subjects.push_back(std::move(subject));
  return rows_of(
      subjects, options.rounds, progress,
      [](const bench::Subject& subject, const CountedTurns& turns, auto& rows) {
        if (subject.name.starts_with("queue/")) return add_row_beside_peer(subject, turns, rows);
        rows.push_back(with_spread_of({subject.name + ", an event", subject.input, subject.beads,
                                       *turns.figure("ns"), "ns", "", std::nullopt, subject.most_ns, true},
                                      turns, "ns"));
        rows.push_back(
            with_spread_of({subject.name + ", a run", subject.input, subject.beads, *turns.figure("run_us"),
                            "us", subject.peer, turns.figure("build_us"), subject.most_ratio},
                           turns, "run_us"));
      });
}

namespace {

constexpr CommandSpec kBenchCommand{
    "kds bench",
    "Compares kds with another library (the peer). The two alternate in one process; figures are medians of\n"
    "processor time.\n\n"
    "  certificates  finding the time at which a certificate fails, compared with CGAL's predicates and "
    "algebraic numbers\n"
    "  engine        whole runs of moving points, compared with CGAL's static build\n"
    "  hierarchies   wrapped and layered hierarchies, compared with CGAL at every node\n"
    "  power         the power diagram from frame to frame, compared with CGAL's static build\n"
    "  collision     the pairs of beads that meet, compared with a cell list, a Verlet list, FCL and "
    "Bullet,\n"
    "                and the times at which contacts begin and end, compared with a cell list\n"
    "  trade         options that trade accuracy for speed, compared with exact runs of kds\n"
    "  readers       reading trajectories of each format, compared with reading the bytes of the file",
    "SUBJECT",
    "certificates, engine, hierarchies, power, collision, trade or readers",
    "kds bench certificates\n"
    "kds bench hierarchies\n"
    "kds bench collision --sizes 10240\n"
    "kds bench power --sizes 10240 --trajectories villin_hp36_300K.dcd --json -",
};

/// The options of the command line.
struct BenchInputs : Destinations {
  std::vector<std::size_t> sizes;  ///< empty for the subject's default
  std::filesystem::path data = source_data_folder();
  std::vector<std::filesystem::path> trajectories;
  std::filesystem::path instances;
  std::size_t rounds = 5;
  std::size_t fewest_beads = 0;  ///< least number of beads that the subject needs in a generated chain
};

using Progress = TableCommand::Progress;
using Rows = std::vector<BenchRow>;

template <auto bench>
Rows on_instances(const BenchInputs& inputs, const Progress& progress) {
  return bench({inputs.instances, inputs.rounds}, progress);
}

template <class Options, auto bench>
Rows on_chains(const BenchInputs& inputs, const Progress& progress) {
  Options options;
  if constexpr (requires { options.sizes; })
    if (!inputs.sizes.empty()) options.sizes = inputs.sizes;
  if constexpr (requires { options.regular; })
    if (!inputs.sizes.empty()) options.regular = inputs.sizes;
  options.trajectories = inputs.trajectories;
  options.rounds = inputs.rounds;
  return bench(options, progress);
}

constexpr std::size_t only_trajectories = std::numeric_limits<std::size_t>::max();

struct Subject {
  std::string_view name;
  std::size_t fewest_beads;  // in a generated chain; 0: runs on instances; or only_trajectories
  Rows (*bench)(const BenchInputs&, const Progress&);
  std::string_view (*what_is_missing)() = nullptr;  // names the rows that this build lacks
};

constexpr std::array kSubjects{
    Subject{"certificates", 0, on_instances<bench_certificates>},
    Subject{"engine", 0, on_instances<bench_engine>},
    Subject{"hierarchies", 2, on_chains<HierarchyBenchOptions, bench_hierarchies>},
    Subject{"collision", 2, on_chains<CollisionBenchOptions, bench_collision>, missing_collision_peers},
    // in space, so the beads should not all lie in one plane
    Subject{"power", 20, on_chains<PowerBenchOptions, bench_power>},
    Subject{"trade", only_trajectories, on_chains<TradeBenchOptions, bench_trade>},
    Subject{"readers", only_trajectories, on_chains<ReaderBenchOptions, bench_readers>},
};

const Subject& subject_of(const std::vector<std::string>& operands) {
  if (operands.size() == 1) {
    for (const Subject& subject : kSubjects)
      if (subject.name == operands[0]) return subject;
  }
  std::vector<std::string_view> names;
  for (const Subject& subject : kSubjects) names.push_back(subject.name);
  throw InputError(fmt::format("kds bench: expected one subject of {}{}", fmt::join(names, ", "),
                               operands.size() == 1 ? suggestion(operands[0], names) : ""));
}

constexpr std::size_t most_count = 10'000'000;

Option<BenchInputs> sizes_option() {
  using O = BenchInputs;
  Option<O> option = list_option({"--sizes", "LIST",
                                  "beads of generated chains, for hierarchies (default: 640,10240,102400), "
                                  "collision (default: 1000,10240,102400) and power (default: 10240, and "
                                  "1000,8000 in regular scenes)"},
                                 &O::sizes, [](const std::string&) { return std::vector<std::size_t>(); });
  option.read = [](O& o, const std::string& list) {
    for (const std::string& text : split(list, ','))
      o.sizes.push_back(parse_whole_number("--sizes", text, o.fewest_beads, most_count));
  };
  option.json = [](const O& o) { return o.sizes.empty() ? Json(nullptr) : Json(o.sizes); };
  return option;
}

Option<BenchInputs> trajectories_option() {
  using O = BenchInputs;
  const auto names = [](const O& o) {
    std::vector<std::string> files;
    for (const std::filesystem::path& file : o.trajectories) files.push_back(file.filename().string());
    return files;  // without folders, so that results of two machines agree
  };
  return {{"--trajectories", "LIST",
           "trajectory files, for hierarchies, power, collision, trade and readers (default: all .dcd files "
           "in the folder trajectories of the data; for readers also the folder formats)"},
          [](O& o, const std::string& list) {
            for (const std::string& path : split(list, ',')) o.trajectories.emplace_back(path);
          },
          [=](const O& o) { return fmt::format("{}", fmt::join(names(o), ",")); },
          nullptr,
          [=](const O& o) { return Json(names(o)); }};
}

Option<BenchInputs> instances_option() {
  using O = BenchInputs;
  Option<O> option = path_option({"--instances", "DIR",
                                  "folder of moving-point files, for certificates and engine (default: the "
                                  "folder kinetic of the data)"},
                                 &O::instances);
  option.json = [](const O& o) {
    return o.instances.empty() ? Json() : Json(o.instances.lexically_normal().filename().string());
  };
  return option;
}

const OptionList<BenchInputs>& bench_options() {
  using O = BenchInputs;
  static const auto list =
      OptionList<O>()
          .with({sizes_option(), data_option(&O::data), trajectories_option(), instances_option(),
                 whole_option(
                     {"--rounds", "N", "alternating runs of kds and the peer, at least 5 (default: 5)"},
                     &O::rounds, 5, most_count)})
          .with(destination_options("write bench.json, bench.csv and report.html to DIR (default: none)"));
  return list;
}

std::vector<std::filesystem::path> trajectories_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".dcd") found.push_back(entry.path());
  if (found.empty()) throw InputError(fmt::format("--data: no .dcd file in {}", folder.string()));
  std::sort(found.begin(), found.end());
  return found;
}

// Returns the trajectories whose atoms another file names.
std::vector<std::filesystem::path> trajectories_of_formats(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const ReaderSpec* const reader = reader_registry().find_by_ending(entry.path());
    if (reader != nullptr && reader->open && reader->takes_topology) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

void refuse_needless_options(const ParsedArguments& parsed, const Subject& subject) {
  const auto refuse = [&](const char* option) {
    if (parsed.has(option)) throw InputError(fmt::format("{}: {} takes none", option, subject.name));
  };
  const bool has_chains = subject.fewest_beads > 0;
  if (!has_chains || subject.fewest_beads == only_trajectories) refuse("--sizes");
  if (!has_chains) refuse("--trajectories");
  if (has_chains) refuse("--instances");
}

std::vector<std::filesystem::path> default_trajectories(const std::filesystem::path& data,
                                                        const Subject& subject) {
  auto found = trajectories_in(folder_in_data(data, "trajectories", "--trajectories"));
  if (subject.name == "readers") {
    const auto others = trajectories_of_formats(folder_in_data(data, "formats", "--trajectories"));
    found.insert(found.end(), others.begin(), others.end());
  }
  return found;
}

BenchInputs read_inputs(const ParsedArguments& parsed, const Subject& subject) {
  refuse_needless_options(parsed, subject);
  BenchInputs inputs;
  inputs.fewest_beads = subject.fewest_beads;
  bench_options().read(parsed, inputs);
  const bool has_chains = subject.fewest_beads > 0;
  if (has_chains && inputs.trajectories.empty())
    inputs.trajectories = default_trajectories(inputs.data, subject);
  if (!has_chains && inputs.instances.empty())
    inputs.instances = folder_in_data(inputs.data, "kinetic", "--instances");
  return inputs;
}

}  // namespace

int bench_command(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kBenchCommand, bench_options().specs(), arguments);
  const Subject& subject = subject_of(parsed.operands());
  const BenchInputs inputs = read_inputs(parsed, subject);
  TableCommand command("bench", arguments, inputs, "measurement");
  command.check_destinations();

  if (subject.what_is_missing != nullptr && !inputs.quiet && !subject.what_is_missing().empty())
    print_warning(command.bar(), std::string(subject.what_is_missing()));
  const Rows rows = subject.bench(inputs, command.progress());
  command.bar().erase();
  const Json settings = bench_options().settings_json(inputs, {{"subject", subject.name}});
  command.deliver_text(bench_json(command.command_line(), settings, rows), settings,
                       {{"bench.csv", bench_csv(rows)}}, bench_table(rows), [&](Page page) {
                         return bench_page(std::string(subject.name), rows, std::move(page));
                       });
  return 0;
}

}  // namespace kds
