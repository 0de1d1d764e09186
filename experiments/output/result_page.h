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

/// Writes the page that `make` makes, if there is such a function, and commits. Where it throws, the figures
/// are safe and the page of an earlier result goes, as it would be taken for theirs; returns what was thrown.
[[nodiscard]] std::exception_ptr commit_with_page(StagedFiles& files,
                                                  const std::function<std::string()>& make);

/// Throws InputError where the directory holds this file, of another command's result, whose page would be
/// lost.
void refuse_page_beside(const std::filesystem::path& directory, std::string_view file,
                        std::string_view command);

}  // namespace kds
