#include "experiments/output/page/result_page.h"

#include "experiments/output/output_files.h"
#include "experiments/output/page/gnuplot.h"

namespace kds {

void check_page(const std::filesystem::path& directory, std::string_view command) {
  check_directory(directory, command, "--out", {"report.html"});
  require_gnuplot("--out");
}

}  // namespace kds
