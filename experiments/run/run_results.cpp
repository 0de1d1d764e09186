#include "experiments/run/run_results.h"

#include <filesystem>
#include <optional>

#include "experiments/output/gnuplot.h"
#include "experiments/output/made_directories.h"
#include "experiments/output/output_error.h"
#include "experiments/output/output_files.h"
#include "experiments/run/events_csv.h"
#include "experiments/run/html_report.h"

namespace kds {

void check_destinations(const Destinations& destinations) {
  if (destinations.json && *destinations.json != "-") ensure_writable_file(*destinations.json, "--json");
  if (!destinations.out) return;
  require_gnuplot("--out");
  check_directory(*destinations.out, "--out", {"summary.json", "events.csv", "report.html"});
}

void deliver(const Destinations& destinations, const RunReport& report, const std::string& json,
             const std::string& table) {
  const bool json_on_stdout = destinations.json == "-";
  const bool table_on_stdout = !destinations.quiet && !json_on_stdout;
  // The figures first: should the plots fail, they are safe.
  std::optional<MadeDirectories> made;
  if (destinations.out) {
    made.emplace(*destinations.out, "--out");
    write_file_atomically(*destinations.out / "summary.json", json);
    write_file_atomically(*destinations.out / "events.csv", events_csv(report));
  }
  if (json_on_stdout) print_to_stdout(json);
  if (destinations.json && !json_on_stdout) write_file_atomically(*destinations.json, json);
  if (table_on_stdout) print_to_stdout(table);
  if (!destinations.out) return;
  const std::filesystem::path page = *destinations.out / "report.html";
  write_file_atomically(page, html_report(report));
  if (table_on_stdout) print_to_stdout("report " + page.string() + "\n");
}

}  // namespace kds
