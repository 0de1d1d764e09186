#include "experiments/compare/compare_command.h"

#include <fmt/format.h>

#include "experiments/compare/compare_options.h"
#include "experiments/compare/compare_page.h"
#include "experiments/compare/compare_report.h"
#include "experiments/compare/compare_runs.h"
#include "experiments/output/output_files.h"
#include "experiments/output/page/result_page.h"
#include "experiments/output/text.h"
#include "experiments/program/option_names.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_results.h"
#include "experiments/program/warnings.h"

namespace kds {

namespace {

constexpr const char* kCompareName = "compare";

void check_destinations(const CompareOptions& options, const Destinations& destinations) {
  TakenPaths taken;
  taken.read(options);
  if (options.out) taken.write_into("--out", *options.out, {"report.html"});
  check_table_destinations(destinations, kCompareName, taken);
  if (!options.out) return;
  check_page(*options.out, "compare");
}

}  // namespace

int compare_command(const Arguments& arguments) {
  const CompareOptions options = parse_compare_options(arguments);
  const Destinations& destinations = options;
  check_inputs_exist(options);
  check_destinations(options, destinations);

  ProgressBar bar(!options.quiet, "step");
  HeldWarnings held;
  const Comparison comparison = compare_runs(
      options, [&bar](std::size_t done, std::size_t total) { bar.update(done, total); }, held.hold());
  bar.erase();
  std::vector<std::string> warnings;
  held.release([&](const std::string& warning) {
    warnings.push_back(warning);
    print_warning(bar, warning);
  });

  const std::string command_line = "kds compare " + shell_words(arguments);
  Json json;
  json["inputs"] = compared_inputs_json(comparison);
  json["settings"] = compare_options().settings_json(options);
  json["rows"] = compare_rows_json(comparison);
  json["warnings"] = warnings;
  add_provenance(json, command_line);
  deliver_table(destinations, kCompareName,
                {text_of(json), compare_csv(comparison), compare_table(comparison), [&] {
                   return compare_page(comparison, made_by(kCompareName, command_line,
                                                           compare_options().settings_json(options)));
                 }});
  return 0;
}

}  // namespace kds
