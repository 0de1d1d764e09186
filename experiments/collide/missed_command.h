#pragma once
// The options of `kds missed`.

#include <span>
#include <string>

#include "experiments/collide/missed_contacts.h"
#include "experiments/output/output_files.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/table.h"
#include "experiments/program/command_line.h"
#include "experiments/program/option.h"

namespace kds {

struct MissedOptions {
  MissedTask task;
  Destinations destinations;
};

/// Returns the options that appear as settings in the JSON.
[[nodiscard]] const OptionList<MissedTask>& missed_task_options();

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] MissedOptions parse_missed_options(const Arguments& arguments);

// Reports the results of `kds missed`.

/// Returns the columns of missed.json and missed.csv, of the terminal and of the page.
[[nodiscard]] const Table<MissedRow>& missed_columns();
/// `page` says how the results were made.
[[nodiscard]] std::string missed_page(std::span<const MissedRow> rows, const std::string& input, Page page);

}  // namespace kds
