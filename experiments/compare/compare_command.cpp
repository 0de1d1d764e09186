#include "experiments/program/commands.h"

#include "experiments/compare/compare_options.h"
#include "experiments/compare/compare_page.h"
#include "experiments/compare/compare_report.h"
#include "experiments/compare/compare_runs.h"
#include "experiments/program/table_command.h"

namespace kds {

int compare_command(const Arguments& arguments) {
  const CompareOptions options = parse_compare_options(arguments);
  TableCommand command("compare", arguments, options, "step");
  command.check_inputs_and_destinations(options);

  const Comparison comparison = compare_runs(options, command.progress(), command.warn());

  Json json;
  json["inputs"] = compared_inputs_json(comparison);
  json["settings"] = compare_options().settings_json(options);
  json["rows"] = compare_columns(comparison).json(comparison.rows);
  json["warnings"] = command.warnings();
  command.deliver(json, compare_columns(comparison).csv(comparison.rows), compare_table(comparison),
                  [&](Page page) { return compare_page(comparison, std::move(page)); });
  return 0;
}

}  // namespace kds
