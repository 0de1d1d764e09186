#pragma once
// report.html beside the figures of a result: the same name for several commands, and the one file that may
// fail.

#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "experiments/output/staged_files.h"

namespace kds {

/// Before work begins. Throws InputError where gnuplot, which draws its plots, is missing, and where the
/// directory holds the result of another command that writes a page, which would be lost. `own` is the file
/// by which the result to come is known: summary.json, of `kds run`, or another of those listed with it.
void check_page(const std::filesystem::path& directory, std::string_view own);

}  // namespace kds
