#include "experiments/output/page/result_page.h"

#include <fmt/format.h>

#include <array>

#include "experiments/output/page/gnuplot.h"
#include "motions/base/input_error.h"

namespace kds {

void check_page(const std::filesystem::path& directory, std::string_view own) {
  struct Result {
    std::string_view file, command;
  };
  constexpr std::array results{
      Result{"summary.json", "kds run"},         Result{"update.json", "kds update"},
      Result{"compare.json", "kds compare"},     Result{"collide.json", "kds collide"},
      Result{"missed.json", "kds missed"},       Result{"reproduce.json", "kds reproduce"},
      Result{"theorems.json", "kds theorems"},   Result{"trade.json", "kds trade"},
      Result{"questions.json", "kds questions"}, Result{"stability.json", "kds stability"},
      Result{"bench.json", "kds bench"}};
  for (const auto& [file, command] : results) {
    std::error_code ignored;
    if (file != own && std::filesystem::exists(directory / file, ignored))
      throw InputError(
          fmt::format("--out {}: holds the result of {} ({}), whose report.html this one would replace; give "
                      "another directory",
                      directory.string(), command, file));
  }
  require_gnuplot("--out");
}

}  // namespace kds
