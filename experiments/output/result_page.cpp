#include "experiments/output/result_page.h"

#include <fmt/format.h>

#include "motions/base/input_error.h"

namespace kds {

std::exception_ptr commit_with_page(StagedFiles& files, const std::function<std::string()>& make) {
  constexpr std::string_view page = "report.html";
  std::exception_ptr thrown;
  if (make) {
    try {
      files.write(std::string(page), make());
    } catch (const std::exception&) {
      thrown = std::current_exception();
    }
  }
  files.commit([&](std::string_view name) { return thrown && name == page; });
  return thrown;
}

void refuse_page_beside(const std::filesystem::path& directory, std::string_view file,
                        std::string_view command) {
  std::error_code ignored;
  if (std::filesystem::exists(directory / file, ignored))
    throw InputError(
        fmt::format("--out {}: holds the result of {} ({}), whose report.html this one would replace; "
                    "give another directory",
                    directory.string(), command, file));
}

}  // namespace kds
