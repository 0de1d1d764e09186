#include "experiments/program/table_results.h"

#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "experiments/output/output_files.h"
#include "experiments/output/page/result_page.h"
#include "experiments/output/staged.h"
#include "experiments/program/taken_paths.h"

namespace kds {

Page made_by(const std::string& name, std::string command_line, Json settings) {
  Page page;
  page.command_line = std::move(command_line);
  page.settings = std::move(settings);
  page.data = {name + ".json", name + ".csv"};
  return page;
}

void check_table_destinations(const Destinations& destinations, const std::string& name, TakenPaths paths) {
  const bool json_file = destinations.json && *destinations.json != "-";
  const std::array<std::string, 2> files{name + ".json", name + ".csv"};
  if (destinations.out) paths.write_into("--out", *destinations.out, {files[0], files[1]});
  if (destinations.json) paths.write_json(*destinations.json);

  if (json_file) ensure_writable_file(*destinations.json, "--json");
  if (!destinations.out) return;
  check_directory(*destinations.out, name, "--out", {files[0], files[1]});
}

void deliver_table(const Destinations& destinations, const std::string& name, const TableResults& results) {
  const bool json_on_stdout = destinations.json == "-";
  std::optional<StagedFiles> files;
  if (destinations.out) {
    files.emplace(*destinations.out, name, "--out");
    files->write(name + ".json", results.json);
    files->write(name + ".csv", results.csv);
    if (results.page) files->write("report.html", results.page());
  }
  std::optional<AtomicFile> json;
  if (destinations.json && !json_on_stdout) json.emplace(*destinations.json, results.json);
  commit_together(std::array<Staged*, 2>{files ? &*files : nullptr, json ? &*json : nullptr});
  if (json_on_stdout) print_to_stdout(results.json);
  if (!destinations.quiet && !json_on_stdout) print_to_stdout(results.table);
}

}  // namespace kds
