#include "experiments/bench/bench_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "experiments/bench/bench_collision.h"
#include "experiments/bench/bench_hierarchies.h"
#include "experiments/bench/bench_power.h"
#include "experiments/bench/bench_subjects.h"
#include "experiments/bench/bench_trade.h"
#include "experiments/bench/collision_peers.h"
#include "experiments/output/output_files.h"
#include "experiments/output/page/result_page.h"
#include "experiments/output/text.h"
#include "experiments/program/data_folder.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/suggestion.h"
#include "experiments/program/table_results.h"
#include "experiments/program/warnings.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr std::array kBenchOptions{
    OptionSpec{
        "--sizes", "LIST",
        "hierarchies, power, collision: beads of generated chains (default: 640,10240,102400; power: 10240, "
        "regular scenes 1000,8000; collision: 1000,10240,102400)"},
    OptionSpec{"--data", "DIR",
               "the folder that holds trajectories and kinetic (default: data beside the sources)"},
    OptionSpec{"--trajectories", "LIST",
               "hierarchies, power, collision, trade: trajectory files (default: DIR/trajectories/*.dcd)"},
    OptionSpec{"--instances", "DIR",
               "certificates, engine: the folder of moving-point files (default: kinetic in that of --data)"},
    OptionSpec{"--rounds", "N", "interleaved runs of ours and the peer, at least 5 (default: 5)"},
    OptionSpec{"--out", "DIR", "write bench.json, bench.csv and report.html there (default: none)"},
    OptionSpec{"--json", "FILE", "write the rows there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr CommandSpec kBenchCommand{
    "kds bench",
    "Measures ours beside a peer in the same process: medians of interleaved runs, processor time.",
    "SUBJECT",
    "certificates: from beads to failure times, beside CGAL's predicates and algebraic numbers; engine: "
    "whole "
    "runs of moving points, beside CGAL's static build; hierarchies: wrapped and layered hierarchies, beside "
    "CGAL at every node; power: the power diagram from frame to frame, beside CGAL's static build; "
    "collision: the pairs of beads that meet, beside a cell list, a Verlet list, FCL and Bullet, and all "
    "times at which they begin and end to, beside the cell list; trade: levers of speed against accuracy, "
    "beside exact runs",
    kBenchOptions,
    "kds bench certificates\n"
    "kds bench hierarchies\n"
    "kds bench collision --sizes 10240\n"
    "kds bench power --sizes 10240 --trajectories villin_hp36_300K.dcd --json -",
};

/// What the command line says.
struct BenchInputs {
  std::optional<std::vector<std::size_t>> sizes;
  std::vector<std::filesystem::path> trajectories;
  std::filesystem::path instances;
  std::size_t rounds = 5;
};

using Progress = std::function<void(std::size_t, std::size_t)>;
using Rows = std::vector<BenchRow>;

template <auto bench>
Rows on_instances(const BenchInputs& inputs, const Progress& progress) {
  return bench({inputs.instances, inputs.rounds}, progress);
}

template <class Options, auto bench>
Rows on_chains(const BenchInputs& inputs, const Progress& progress) {
  Options options;
  if constexpr (requires { options.sizes; })
    if (inputs.sizes) options.sizes = *inputs.sizes;
  if constexpr (requires { options.regular; })
    if (inputs.sizes) options.regular = *inputs.sizes;
  options.trajectories = inputs.trajectories;
  options.rounds = inputs.rounds;
  return bench(options, progress);
}

constexpr std::size_t only_trajectories = std::numeric_limits<std::size_t>::max();

struct Subject {
  std::string_view name;
  std::size_t fewest_beads;  // of a generated chain; 0: it runs on instances; or only_trajectories
  Rows (*bench)(const BenchInputs&, const Progress&);
  std::string_view (*what_is_missing)() = nullptr;  // a line about rows that this build cannot have
};

constexpr std::array kSubjects{
    Subject{"certificates", 0, on_instances<bench_certificates>},
    Subject{"engine", 0, on_instances<bench_engine>},
    Subject{"hierarchies", 2, on_chains<HierarchyBenchOptions, bench_hierarchies>},
    Subject{"collision", 2, on_chains<CollisionBenchOptions, bench_collision>, missing_collision_peers},
    // In space, where all beads should not lie in one plane.
    Subject{"power", 20, on_chains<PowerBenchOptions, bench_power>},
    Subject{"trade", only_trajectories, on_chains<TradeBenchOptions, bench_trade>},
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

std::size_t parse_count(std::string_view option, const std::string& text, std::size_t least) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  constexpr std::size_t most = 10'000'000;
  if (error == std::errc() && end == text.data() + text.size() && number >= least && number <= most)
    return number;
  throw InputError(fmt::format("{}: '{}' is not a whole number from {} to {}", option, text, least, most));
}

// A folder of the data that inputs are taken from unless they are named one by one.
std::filesystem::path folder_of_data(const ParsedArguments& parsed, const char* name, const char* instead) {
  const std::filesystem::path data = data_folder(parsed);
  std::error_code none;
  if (std::filesystem::is_directory(data / name, none)) return data / name;
  throw InputError(
      fmt::format("--data: there is no folder {}; expected the folder data of the sources, or inputs with {}",
                  (data / name).string(), instead));
}

std::vector<std::filesystem::path> trajectories_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".dcd") found.push_back(entry.path());
  if (found.empty()) throw InputError(fmt::format("--data: no .dcd file in {}", folder.string()));
  std::sort(found.begin(), found.end());
  return found;
}

Json settings_json(std::string_view subject, const BenchInputs& inputs) {
  Json trajectories = Json::array();
  for (const std::filesystem::path& file : inputs.trajectories) trajectories.push_back(file.string());
  return {{"subject", subject},
          {"sizes", inputs.sizes ? Json(*inputs.sizes) : Json(nullptr)},
          {"trajectories", trajectories},
          {"instances", inputs.instances.string()},
          {"rounds", inputs.rounds}};
}

}  // namespace

int bench_command(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kBenchCommand, arguments);
  const Subject& subject = subject_of(parsed.operands());
  const bool chains = subject.fewest_beads > 0;
  for (const char* option : {"--sizes", "--trajectories"})
    if (!chains && parsed.has(option))
      throw InputError(fmt::format("{}: {} takes none", option, subject.name));
  if (subject.fewest_beads == only_trajectories && parsed.has("--sizes"))
    throw InputError(fmt::format("--sizes: {} takes none", subject.name));
  if (chains && parsed.has("--instances"))
    throw InputError(fmt::format("--instances: {} takes none", subject.name));
  BenchInputs inputs;
  if (const auto list = parsed.value("--sizes")) {
    inputs.sizes.emplace();
    for (const std::string& text : split(*list, ','))
      inputs.sizes->push_back(parse_count("--sizes", text, subject.fewest_beads));
  }
  if (const auto list = parsed.value("--trajectories")) {
    for (const std::string& path : split(*list, ',')) inputs.trajectories.emplace_back(path);
  } else if (chains) {
    inputs.trajectories = trajectories_in(folder_of_data(parsed, "trajectories", "--trajectories"));
  }
  if (const auto folder = parsed.value("--instances")) {
    inputs.instances = *folder;
  } else if (!chains) {
    inputs.instances = folder_of_data(parsed, "kinetic", "--instances");
  }
  if (const auto text = parsed.value("--rounds")) inputs.rounds = parse_count("--rounds", *text, 5);
  Destinations destinations;
  if (const auto text = parsed.value("--out")) {
    if (*text == "-") throw InputError("--out needs a path; - is for --json only");
    destinations.out = *text;
  }
  destinations.json = parsed.value("--json");
  destinations.quiet = parsed.has("--quiet");
  TakenPaths taken;
  if (destinations.out) taken.write_into("--out", *destinations.out, {"report.html"});
  check_table_destinations(destinations, "bench", taken);
  if (destinations.out) {
    check_page(*destinations.out, "bench");
  }

  ProgressBar bar(!destinations.quiet, "measurement");
  if (subject.what_is_missing != nullptr && !destinations.quiet && !subject.what_is_missing().empty())
    print_warning(bar, std::string(subject.what_is_missing()));
  const Rows rows =
      subject.bench(inputs, [&bar](std::size_t done, std::size_t total) { bar.update(done, total); });
  bar.erase();
  const std::string command_line = "kds bench " + shell_words(arguments);
  const Json settings = settings_json(subject.name, inputs);
  deliver_table(destinations, "bench",
                {bench_json(command_line, settings, rows), bench_csv(rows), bench_table(rows), [&] {
                   return bench_page(std::string(subject.name), rows,
                                     made_by("bench", command_line, settings));
                 }});
  return 0;
}

}  // namespace kds
