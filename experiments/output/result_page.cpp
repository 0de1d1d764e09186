#include "experiments/output/result_page.h"

#include <fmt/format.h>

#include <array>

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

void refuse_page_beside_others(const std::filesystem::path& directory, std::string_view own) {
  struct Result {
    std::string_view file, command;
  };
  constexpr std::array results{
      Result{"summary.json", "kds run"},      Result{"update.json", "kds update"},
      Result{"compare.json", "kds compare"},  Result{"collide.json", "kds collide"},
      Result{"missed.json", "kds missed"},    Result{"reproduce.json", "kds reproduce"},
      Result{"theorems.json", "kds theorems"}};
  for (const auto& [file, command] : results) {
    std::error_code ignored;
    if (file != own && std::filesystem::exists(directory / file, ignored))
      throw InputError(
          fmt::format("--out {}: holds the result of {} ({}), whose report.html this one would replace; "
                      "give another directory",
                      directory.string(), command, file));
  }
}

}  // namespace kds
