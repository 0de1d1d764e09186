#include "experiments/bench_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>

#include "experiments/bench_hierarchies.h"
#include "experiments/progress_bar.h"
#include "experiments/table_results.h"
#include "experiments/text.h"
#include "motions/input_error.h"

namespace kds {

namespace {

constexpr std::array kOptions{
    OptionSpec{"--sizes", "LIST", "beads of generated chains (default: 640,10240,102400)"},
    OptionSpec{"--trajectories", "LIST",
               "trajectory files (default: those of data/trajectories here, *.dcd)"},
    OptionSpec{"--rounds", "N", "interleaved runs of ours and the peer, at least 5 (default: 5)"},
    OptionSpec{"--out", "DIR", "write bench.json and bench.csv there (default: none)"},
    OptionSpec{"--json", "FILE", "write the rows there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr CommandSpec kCommand{
    "kds bench",
    "Measures ours beside a peer in the same process: medians of interleaved runs, processor time.",
    "SUBJECT",
    "hierarchies: wrapped and layered hierarchies, beside CGAL at every node",
    kOptions,
    "kds bench hierarchies\n"
    "kds bench hierarchies --sizes 10240 --trajectories data/trajectories/villin_hp36_300K.dcd --json -",
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
  if (parsed.operands().size() != 1 || parsed.operands()[0] != "hierarchies")
    throw InputError("kds bench: expected one subject, hierarchies");
  HierarchyBenchOptions options;
  if (const auto list = parsed.value("--sizes")) {
    options.sizes.clear();
    for (const std::string& text : split(*list, ','))
      options.sizes.push_back(parse_count("--sizes", text, 2));
  }
  if (const auto list = parsed.value("--trajectories")) {
    for (const std::string& path : split(*list, ',')) options.trajectories.emplace_back(path);
  } else {
    options.trajectories = trajectories_here();
  }
  if (const auto text = parsed.value("--rounds")) options.rounds = parse_count("--rounds", *text, 5);
  Destinations destinations;
  if (const auto text = parsed.value("--out")) {
    if (*text == "-") throw InputError("--out needs a path; - is for --json only");
    destinations.out = *text;
  }
  destinations.json = parsed.value("--json");
  destinations.quiet = parsed.has("--quiet");
  check_table_destinations(destinations, "bench");

  ProgressBar bar(!destinations.quiet);
  const std::vector<BenchRow> rows =
      bench_hierarchies(options, [&bar](std::size_t done, std::size_t total) { bar.update(done, total); });
  bar.erase();
  deliver_table(destinations, "bench", {bench_json(rows), bench_csv(rows), bench_table(rows)});
  return 0;
}

}  // namespace kds
