#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "experiments/impacts/query_file.h"
#include "experiments/output/output_files.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "kds/stopwatch.h"
#include "motions/base/input_error.h"
#include "motions/base/interruption.h"
#include "structures/impacts/impact_search.h"

namespace kds {

namespace {

constexpr std::array<std::string_view, 2> kKinds{"vertex-face", "edge-edge"};

constexpr CommandSpec kCcdCommand{
    "kds ccd",
    "Decides exactly whether a point meets a triangle, or two edges meet, on straight paths, and when first.",
    "FILE...",
    "queries of eight lines each: four points at time 0 and at time 1, as numerators and denominators (also "
    ".gz)",
    "kds ccd queries.csv.gz --kind edge-edge --csv answers.csv\n"
    "kds ccd spikes/vertex-face/*.csv --kind vertex-face"};

std::vector<OptionSpec> ccd_options() {
  return {{"--kind", "NAME",
           "vertex-face (a point and the corners of a triangle) or edge-edge (the ends of two "
           "edges); must be given"},
          {"--csv", "FILE",
           "write a line for each query to FILE: query,collides,first; - is standard output "
           "(default: none)"}};
}

/// Writes a line for each query: its number from 0, 0 or 1, and the time of the first impact.
class AnswerLines {
 public:
  AnswerLines(const std::optional<std::string>& destination, AtomicFiles& files)
      : stream_(!destination          ? nullptr
                : *destination == "-" ? &std::cout
                                      : &files.open(*destination)) {
    if (stream_ != nullptr) *stream_ << "query,collides,first\n";
  }
  void add(std::uint64_t query, const std::optional<Impact>& impact) {
    if (stream_ == nullptr) return;
    const std::string time =
        impact ? fmt::format("{:.12g}", 0.5 * impact->lower + 0.5 * impact->upper) : std::string();
    *stream_ << fmt::format("{},{},{}\n", query, impact ? 1 : 0, time);
  }

 private:
  std::ostream* stream_;
};

struct Answers {
  std::uint64_t queries = 0, collide = 0, known = 0, others = 0;
  std::string first_other;  ///< the first query that the file answers otherwise
};

/// Returns two lines: the total time, and quantiles of the time per query.
std::string times_text(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  const auto quantile = [&](double share) {
    return seconds[static_cast<std::size_t>(share * static_cast<double>(seconds.size() - 1))];
  };
  return fmt::format(
      "seconds  {:.4g}\nseconds of a query  median {:.3g}, 99th percentile {:.3g}, maximum {:.3g}\n",
      std::accumulate(seconds.begin(), seconds.end(), 0.0), quantile(0.5), quantile(0.99), quantile(1));
}

}  // namespace

int ccd_command(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kCcdCommand, ccd_options(), arguments);
  if (!parsed.has("--kind")) throw InputError("--kind", "give vertex-face or edge-edge");
  const auto kind = choice_of<ImpactKind>("--kind", *parsed.value("--kind"), kKinds);
  const std::optional<std::string> csv = parsed.value("--csv");
  if (parsed.operands().empty()) throw InputError("kds ccd needs at least one FILE (see kds ccd --help)");
  TakenPaths taken;
  for (const std::string& file : parsed.operands()) taken.add("the input", file);
  if (csv && *csv != "-") {
    ensure_writable_file(*csv, "--csv");
    taken.write("--csv", *csv);
  }

  AtomicFiles files;
  AnswerLines lines(csv, files);
  ImpactSearch search(kind);
  Answers answers;
  std::vector<double> seconds;
  for (const std::string& file : parsed.operands()) {
    QueryFile queries(file);
    ImpactQuery query;
    for (std::uint64_t in_file = 0; queries.next(query); ++in_file) {
      InterruptionCheck::ask();
      std::optional<Impact> first;
      seconds.push_back(seconds_of<WallClock>([&] { first = search.first_impact(query.points); }));
      lines.add(answers.queries++, first);
      if (first) ++answers.collide;
      if (!query.answer) continue;
      ++answers.known;
      if (*query.answer == first.has_value()) continue;
      if (answers.others++ == 0) answers.first_other = fmt::format("query {} of {}", in_file, file);
    }
  }
  if (answers.queries == 0)
    throw InputError(fmt::format("{}: expected queries, found none", fmt::join(parsed.operands(), ", ")));
  commit_together({&files});
  std::string text = fmt::format("queries  {}\ncollide  {}\n{}", with_thousands(answers.queries),
                                 with_thousands(answers.collide), times_text(std::move(seconds)));
  if (answers.known > 0)
    text += fmt::format("answers  {} known, {} otherwise\n", with_thousands(answers.known),
                        with_thousands(answers.others));
  if (answers.others > 0) text += fmt::format("first    {}\n", answers.first_other);
  (csv == "-" ? std::cerr : std::cout) << text;
  return answers.others > 0 ? 1 : 0;
}

}  // namespace kds
