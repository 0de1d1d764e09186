#include "experiments/run/run_results.h"

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>

#include "experiments/output/gnuplot.h"
#include "experiments/output/output_error.h"
#include "experiments/output/output_files.h"
#include "experiments/output/result_page.h"
#include "experiments/run/html_report.h"

namespace kds {

namespace {

constexpr std::array<std::string_view, 3> kFiles{"summary.json", "events.csv", "report.html"};

}  // namespace

void check_destinations(const Destinations& destinations) {
  if (destinations.json && *destinations.json != "-") ensure_writable_file(*destinations.json, "--json");
  if (!destinations.out) return;
  require_gnuplot("--out");
  check_directory(*destinations.out, "--out", {kFiles[0], kFiles[1], kFiles[2]});
  refuse_page_beside(*destinations.out, "update.json", "kds update");
}

void RunResults::begin(const Scene& scene) {
  if (!destinations_.out) return;
  files_.emplace(*destinations_.out, "--out");
  events_.emplace(files_->open("events.csv"), scene.stamp(0).picoseconds.has_value());
}

void RunResults::add_step(const FrameStamp& frame, std::string_view structure, std::uint64_t events) {
  if (!events_) return;
  events_->add(frame, structure, events);
  files_->check();
}

void RunResults::deliver(const RunReport& report, const std::string& json, const std::string& table) {
  const bool json_on_stdout = destinations_.json == "-";
  const bool table_on_stdout = !destinations_.quiet && !json_on_stdout;
  std::exception_ptr no_page;
  if (files_) {
    files_->write("summary.json", json);
    no_page = commit_with_page(*files_, [&] { return html_report(report); });
  }
  if (json_on_stdout) print_to_stdout(json);
  if (destinations_.json && !json_on_stdout) write_file_atomically(*destinations_.json, json);
  if (table_on_stdout) print_to_stdout(table);
  if (no_page) std::rethrow_exception(no_page);
  if (files_ && table_on_stdout)
    print_to_stdout("report " + (*destinations_.out / "report.html").string() + "\n");
}

}  // namespace kds
