#pragma once
// Where the results of a command that prints a table go: NAME.json and NAME.csv in --out, --json, standard
// output.

#include <functional>
#include <string>

#include "experiments/output/destinations.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/program/taken_paths.h"

namespace kds {

struct TableResults {
  std::string json, csv, table;
  std::function<std::string()> page = {};  ///< makes report.html for --out; none: there is no page
};

/// A page that is yet to be filled: how it was made, and the files that deliver_table writes beside it.
[[nodiscard]] Page made_by(const std::string& name, std::string command_line, Json settings);

/// Throws InputError where something could not be written later, or would replace another result or one of
/// the files that are taken.
void check_table_destinations(const Destinations& destinations, const std::string& name,
                              TakenPaths taken = {});

/// The table is printed unless quiet, or where standard output is the JSON's. The files of --out appear
/// together, as those of a run do.
void deliver_table(const Destinations& destinations, const std::string& name, const TableResults& results);

}  // namespace kds
