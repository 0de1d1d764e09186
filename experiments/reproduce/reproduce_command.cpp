#include "experiments/reproduce/reproduce_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "experiments/output/destinations.h"
#include "experiments/output/output_files.h"
#include "experiments/output/page/result_page.h"
#include "experiments/output/staged.h"
#include "experiments/output/text.h"
#include "experiments/program/data_folder.h"
#include "experiments/program/option_values.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/taken_paths.h"
#include "experiments/reproduce/paper_tables.h"
#include "experiments/reproduce/reproduce_report.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr std::string_view kCommand = "reproduce";
constexpr const char* kResult = "reproduce.json";

constexpr std::array kReproduceOptions{
    OptionSpec{"--data", "DIR", "the folder data of the sources, for proteins (default: where it was built)"},
    OptionSpec{"--rounds", "N",
               "of each measurement of time of at most a second, of which the median counts (default: 5)"},
    OptionSpec{"--out", "DIR",
               "write table1.csv ... of these tables, reproduce.json and report.html there (default: none)"},
    OptionSpec{"--json", "FILE", "write the rows there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr CommandSpec kReproduceCommand{
    "kds reproduce",
    "Measures the tables of Agarwal et al. (2004) again, each row beside the paper's, times as ratios.",
    "TABLE...",
    "table1 ... table7, or all",
    kReproduceOptions,
    "kds reproduce all --out report\nkds reproduce table1 table6 --json -",
};

std::string file_of(int table) { return fmt::format("table{}.csv", table); }

// Ascending.
std::vector<int> tables_asked_for(const ParsedArguments& parsed) {
  if (parsed.operands().empty())
    throw InputError(
        "kds reproduce needs at least one TABLE, table1 ... table7, or all (see kds reproduce --help)");
  std::vector<int> tables;
  std::vector<std::string> names{"all"};
  for (int table = 1; table <= paper_table_count; ++table) names.push_back(fmt::format("table{}", table));
  for (const std::string& name : parsed.operands()) {
    bool known = false;
    for (int table = 1; table <= paper_table_count; ++table) {
      if (name != "all" && name != names[static_cast<std::size_t>(table)]) continue;
      known = true;
      if (std::find(tables.begin(), tables.end(), table) != tables.end())
        throw InputError(fmt::format("TABLE: table{} is listed twice", table));
      tables.push_back(table);
    }
    if (!known)
      refuse_unknown("TABLE", name, std::vector<std::string_view>(names.begin(), names.end()),
                     "one of table1 ... table7, all");
  }
  std::sort(tables.begin(), tables.end());
  return tables;
}

void check_destinations(const Destinations& destinations, const std::vector<int>& tables,
                        const std::filesystem::path& data) {
  TakenPaths taken;
  taken.read_folder("--data", data);
  if (destinations.out) {
    check_directory(*destinations.out, kCommand, "--out", {kResult});
    taken.write_into("--out", *destinations.out, {kResult, "report.html"});
    for (const int table : tables) {
      taken.write("--out", *destinations.out / file_of(table));
      check_directory(*destinations.out, kCommand, "--out", {file_of(table)});
    }
    check_page(*destinations.out, kCommand);
  }
  if (!destinations.json) return;
  taken.write_json(*destinations.json);
  if (*destinations.json != "-") ensure_writable_file(*destinations.json, "--json");
}

std::vector<PaperTable> measure(const std::vector<int>& numbers, const std::filesystem::path& data,
                                std::size_t rounds, ProgressBar& bar) {
  std::vector<PaperTablePlan> plans;
  std::size_t done = 0, total = 0;
  for (const int number : numbers) {
    plans.push_back(plan_paper_table(number, data, rounds));
    total += plans.back().rows.size();
  }
  std::vector<PaperTable> tables;
  for (PaperTablePlan& plan : plans) {
    for (const auto& row : plan.rows) {
      plan.table.rows.push_back(row());
      bar.update(++done, total);
    }
    tables.push_back(std::move(plan.table));
  }
  bar.erase();
  return tables;
}

void deliver(const Destinations& destinations, const std::vector<PaperTable>& tables, const std::string& json,
             Page page) {
  std::optional<StagedFiles> files;
  std::optional<AtomicFile> json_file;
  if (destinations.out) {
    files.emplace(*destinations.out, kCommand, "--out");
    for (const PaperTable& table : tables) files->write(file_of(table.number), paper_csv(table));
    files->write(kResult, json);
    page.data = {kResult};
    for (const PaperTable& table : tables) page.data.push_back(file_of(table.number));
    files->write("report.html", paper_page(tables, page));
  }
  const bool json_on_stdout = destinations.json == "-";
  if (destinations.json && !json_on_stdout) json_file.emplace(*destinations.json, json);
  commit_together(std::array<Staged*, 2>{files ? &*files : nullptr, json_file ? &*json_file : nullptr});
  if (json_on_stdout) print_to_stdout(json);
  if (!destinations.quiet && !json_on_stdout) print_to_stdout(paper_text(tables));
}

}  // namespace

int reproduce_command(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kReproduceCommand, arguments);
  const std::vector<int> numbers = tables_asked_for(parsed);
  std::size_t rounds = 5;
  if (const auto text = parsed.value("--rounds")) rounds = parse_whole_number("--rounds", *text, 1, 1000);
  const Destinations destinations{path_of(parsed, "--out"), parsed.value("--json"), parsed.has("--quiet")};
  const std::filesystem::path data = data_folder(parsed, {"paper"});
  check_destinations(destinations, numbers, data);

  ProgressBar bar(!destinations.quiet, "row");
  const std::vector<PaperTable> tables = measure(numbers, data, rounds, bar);
  std::vector<std::string> names;
  for (const int number : numbers) names.push_back(fmt::format("table{}", number));
  const std::string command_line = "kds reproduce " + shell_words(arguments);
  Json json;
  const Json settings{{"tables", names}, {"rounds", rounds}};
  json["settings"] = settings;
  json["rows"] = paper_rows_json(tables);
  json["tables"] = paper_findings_json(tables);
  add_provenance(json, command_line);
  Page page;
  page.command_line = command_line;
  page.settings = settings;
  deliver(destinations, tables, text_of(json), std::move(page));
  return 0;
}

}  // namespace kds
