#pragma once
// report.html: one file that shows a result in a browser, without a network. It is the page that
// experiments/pages builds, with the result's JSON and these links in it.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/output_files.h"

namespace kds {

inline constexpr std::string_view report_name = "report.html";

struct ReportLinks {
  std::vector<std::string> data = {};  ///< names of the data files beside the page
  std::filesystem::path replay = {};   ///< path of a replay from the page's folder; empty if there is none
};

/// Writes the page to `file`, which `files` may hold relative to its directory. `json` is the whole result,
/// as text.
void write_report(AtomicFiles& files, const std::filesystem::path& file, std::string_view json,
                  const ReportLinks& links);

/// Returns the path of `replay`, a page that this command writes, from `directory`. Returns an empty path
/// without such a page.
[[nodiscard]] std::filesystem::path replay_beside(const std::filesystem::path& directory,
                                                  const std::optional<std::filesystem::path>& replay);

/// Prints the line "report PATH", with the path of the page in this directory.
void print_report_path(const std::filesystem::path& directory);

}  // namespace kds
