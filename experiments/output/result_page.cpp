#include "experiments/output/result_page.h"

#include <fmt/format.h>

#include "motions/base/input_error.h"

namespace kds {

std::exception_ptr add_page(StagedFiles& files, const std::function<std::string()>& make) {
  static constexpr std::string_view page = "report.html";
  if (!make) return nullptr;
  try {
    files.write(std::string(page), make());
    return nullptr;
  } catch (const std::exception&) {
    files.replace([](std::string_view name) { return name == page; });
    return std::current_exception();
  }
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
