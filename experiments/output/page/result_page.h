#pragma once
// report.html beside the figures of a result: the one file that may fail.

#include <filesystem>
#include <string_view>

namespace kds {

/// Checks before work begins that the page can be written. Throws InputError if gnuplot, which draws its
/// plots, is missing, or if the directory has a report.html that this command did not write.
void check_page(const std::filesystem::path& directory, std::string_view command);

}  // namespace kds
