#include "experiments/program/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiments/program/input_options.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/reproduce/paper_tables.h"
#include "experiments/reproduce/reproduce_report.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr CommandSpec kReproduceCommand{
    "kds reproduce",
    "Measures the tables of Agarwal et al. (2004) again. Shows each row beside the paper's, and times as "
    "ratios.",
    "TABLE...",
    "table1, table2 ... table7, or all",
    "kds reproduce all --out report\nkds reproduce table1 table6 --json -",
};

struct ReproduceOptions : Destinations {
  std::filesystem::path data = source_data_folder();
  std::size_t rounds = 5;
};

const OptionList<ReproduceOptions>& reproduce_options() {
  using O = ReproduceOptions;
  static const auto list =
      OptionList<O>()
          .with({data_option(&O::data),
                 whole_option({"--rounds", "N",
                               "repeat each measurement of time N times, unless it takes more than a second, "
                               "and report the median (default: 5)"},
                              &O::rounds, 1, 1000)})
          .with(destination_options("write reproduce.json, report.html and table1.csv ..., a file for each "
                                    "table, to DIR (default: none)"));
  return list;
}

std::string file_of(int table) { return fmt::format("table{}.csv", table); }

// Returns the numbers in ascending order.
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

std::vector<std::string> files_of(const std::vector<int>& tables) {
  std::vector<std::string> files{"reproduce.json", "report.html"};
  for (const int table : tables) files.push_back(file_of(table));
  return files;
}

std::vector<PaperTable> measure(const std::vector<int>& numbers, const ReproduceOptions& options,
                                const TableCommand::Progress& progress) {
  std::vector<PaperTablePlan> plans;
  std::size_t done = 0, total = 0;
  for (const int number : numbers) {
    plans.push_back(plan_paper_table(number, options.data, options.rounds));
    total += plans.back().rows.size();
  }
  std::vector<PaperTable> tables;
  for (PaperTablePlan& plan : plans) {
    for (const auto& row : plan.rows) {
      plan.table.rows.push_back(row());
      progress(++done, total);
    }
    tables.push_back(std::move(plan.table));
  }
  return tables;
}

}  // namespace

int reproduce_command(const Arguments& arguments) {
  ReproduceOptions options;
  const ParsedArguments parsed = read_arguments(kReproduceCommand, reproduce_options(), arguments, options);
  const std::vector<int> numbers = tables_asked_for(parsed);
  folder_in_data(options.data, "paper");
  TableCommand command("reproduce", arguments, options, "row");
  TakenPaths taken;
  taken.read_folder("--data", options.data);
  command.check_destinations(std::move(taken), files_of(numbers));

  const std::vector<PaperTable> tables = measure(numbers, options, command.progress());
  command.bar().erase();
  std::vector<std::string> names;
  for (const int number : numbers) names.push_back(fmt::format("table{}", number));
  Json json;
  json["settings"] = reproduce_options().settings_json(options, {{"tables", names}});
  json["rows"] = paper_rows_json(tables);
  json["tables"] = paper_findings_json(tables);
  TableCommand::Csvs csvs;
  for (const PaperTable& table : tables) csvs.emplace_back(file_of(table.number), paper_csv(table));
  command.deliver(json, csvs, paper_text(tables),
                  [&](Page page) { return paper_page(tables, std::move(page)); });
  return 0;
}

}  // namespace kds
