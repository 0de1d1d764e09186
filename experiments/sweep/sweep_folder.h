#pragma once
// The folder of a sweep keeps the sweep in plan.json, for `status` and `collect`: SWEEP.json, the folder from
// which its relative paths lead, and the files that its patterns found.

#include <filesystem>
#include <string>

#include "experiments/output/result_json.h"
#include "experiments/sweep/sweep_inputs.h"

namespace kds {

struct KeptPlan {
  Json sweep;                      ///< the content of SWEEP.json
  std::filesystem::path relative;  ///< the folder from which relative paths lead
  Json files;                      ///< PatternFiles::json
  std::string subject;             ///< the path of plan.json, for messages
};

/// Returns the content of SWEEP.json. Throws InputError if it cannot be read.
[[nodiscard]] std::string text_of_sweep(const std::filesystem::path& file);

/// Throws InputError unless the folder is that of a sweep, or is empty, or does not exist.
void check_sweep_folder(const std::filesystem::path& folder);
/// Makes the folder and writes plan.json, unless it has that content. Throws InputError or OutputError.
void keep_plan(const std::filesystem::path& folder, const Json& sweep, const std::filesystem::path& relative,
               const PatternFiles& files);
/// Throws InputError if the folder has no plan.json.
[[nodiscard]] KeptPlan kept_plan(const std::filesystem::path& folder);

}  // namespace kds
