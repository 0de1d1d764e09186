#include "experiments/bench_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <optional>

#include "experiments/bench_hierarchies.h"
#include "experiments/bench_power.h"
#include "experiments/bench_subjects.h"
#include "experiments/progress_bar.h"
#include "experiments/table_results.h"
#include "experiments/text.h"
#include "motions/input_error.h"

namespace kds {

namespace {

constexpr std::array kOptions{
    OptionSpec{"--sizes", "LIST",
               "hierarchies, power: beads of generated chains (default: 640,10240,102400; power: 10240)"},
    OptionSpec{"--trajectories", "LIST",
               "hierarchies, power: trajectory files (default: those of data/trajectories here, *.dcd)"},
    OptionSpec{"--instances", "DIR",
               "certificates, engine: the folder of moving-point files (default: data/kinetic)"},
    OptionSpec{"--rounds", "N", "interleaved runs of ours and the peer, at least 5 (default: 5)"},
    OptionSpec{"--out", "DIR", "write bench.json and bench.csv there (default: none)"},
    OptionSpec{"--json", "FILE", "write the rows there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr CommandSpec kCommand{
    "kds bench",
    "Measures ours beside a peer in the same process: medians of interleaved runs, processor time.",
    "SUBJECT",
    "certificates: from beads to failure times, beside CGAL's predicates and algebraic numbers; engine: "
    "whole "
    "runs of moving points, beside CGAL's static build; hierarchies: wrapped and layered hierarchies, beside "
    "CGAL at every node; power: the power diagram from frame to frame, beside CGAL's static build",
    kOptions,
    "kds bench certificates\n"
    "kds bench hierarchies\n"
    "kds bench power --sizes 10240 --trajectories data/trajectories/villin_hp36_300K.dcd --json -",
};

std::size_t parse_count(std::string_view option, const std::string& text, std::size_t least) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  constexpr std::size_t most = 10'000'000;
  if (error == std::errc() && end == text.data() + text.size() && number >= least && number <= most)
    return number;
  throw InputError(fmt::format("{}: '{}' is not a whole number from {} to {}", option, text, least, most));
}

std::vector<std::filesystem::path> trajectories_here() {
  std::vector<std::filesystem::path> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("data/trajectories", none))
    if (entry.path().extension() == ".dcd") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

int bench_command(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kCommand, arguments);
  const std::vector<std::string>& subject = parsed.operands();
  constexpr std::array<std::string_view, 4> subjects{"certificates", "engine", "hierarchies", "power"};
  if (subject.size() != 1 || std::find(subjects.begin(), subjects.end(), subject[0]) == subjects.end())
    throw InputError("kds bench: expected one subject of certificates, engine, hierarchies, power");
  const bool on_chains = subject[0] == "hierarchies" || subject[0] == "power";
  for (const char* option : {"--sizes", "--trajectories"})
    if (!on_chains && parsed.has(option))
      throw InputError(fmt::format("{}: {} takes none", option, subject[0]));
  if (on_chains && parsed.has("--instances"))
    throw InputError(fmt::format("--instances: {} takes none", subject[0]));
  std::optional<std::vector<std::size_t>> sizes;
  if (const auto list = parsed.value("--sizes")) {
    sizes.emplace();
    // A power diagram in space needs four beads, and beads that do not all lie in one plane.
    for (const std::string& text : split(*list, ','))
      sizes->push_back(parse_count("--sizes", text, subject[0] == "power" ? 20 : 2));
  }
  std::vector<std::filesystem::path> trajectories;
  if (const auto list = parsed.value("--trajectories")) {
    for (const std::string& path : split(*list, ',')) trajectories.emplace_back(path);
  } else {
    trajectories = trajectories_here();
  }
  std::size_t rounds = 5;
  if (const auto text = parsed.value("--rounds")) rounds = parse_count("--rounds", *text, 5);
  Destinations destinations;
  if (const auto text = parsed.value("--out")) {
    if (*text == "-") throw InputError("--out needs a path; - is for --json only");
    destinations.out = *text;
  }
  destinations.json = parsed.value("--json");
  destinations.quiet = parsed.has("--quiet");
  check_table_destinations(destinations, "bench");

  ProgressBar bar(!destinations.quiet);
  const auto progress = [&bar](std::size_t done, std::size_t total) { bar.update(done, total); };
  const auto run = [&](auto options, auto bench) {
    if (sizes) options.sizes = *sizes;
    options.trajectories = trajectories;
    options.rounds = rounds;
    return bench(options, progress);
  };
  const SubjectBenchOptions on_instances{parsed.value("--instances").value_or("data/kinetic"), rounds};
  const std::vector<BenchRow> rows = subject[0] == "certificates" ? bench_certificates(on_instances, progress)
                                     : subject[0] == "engine"     ? bench_engine(on_instances, progress)
                                     : subject[0] == "power"
                                         ? run(PowerBenchOptions{}, bench_power)
                                         : run(HierarchyBenchOptions{}, bench_hierarchies);
  bar.erase();
  deliver_table(destinations, "bench", {bench_json(rows), bench_csv(rows), bench_table(rows)});
  return 0;
}

}  // namespace kds
