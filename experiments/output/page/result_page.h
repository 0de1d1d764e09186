#pragma once
// Checks for report.html, the one result file that can fail because gnuplot is missing.

#include <filesystem>
#include <string_view>

namespace kds {

/// Checks before work begins that the page can be written. Throws InputError if gnuplot, which draws its
/// plots, is missing. Throws InputError also if the directory has a report.html that this command did not
/// write.
void check_page(const std::filesystem::path& directory, std::string_view command);

}  // namespace kds
