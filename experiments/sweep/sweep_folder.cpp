#include "experiments/sweep/sweep_folder.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "experiments/output/output_files.h"
#include "experiments/sweep/run_sweep.h"
#include "motions/base/input_error.h"
#include "motions/base/input_file.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPlan = "plan.json";

std::string plan_text(const Json& sweep, const fs::path& folder, const PatternFiles& files) {
  if (!line_of(Json(folder.string())))
    throw InputError(fmt::format(
        "{}: the name of this folder is not UTF-8; expected the file of the sweep in another folder",
        folder.string()));
  return text_of({{"folder", folder.string()}, {"files", files.json()}, {"sweep", sweep}});
}

// Returns whether a folder holds nothing, or what a sweep makes before and with plan.json.
bool is_new(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator file(folder, error), end; file != end && !error; file.increment(error)) {
    const fs::path name = file->path().filename();
    if (name != results_folder("").filename() && !name.string().starts_with(".kds-")) return false;
  }
  return true;
}

}  // namespace

std::string text_of_sweep(const fs::path& path) {
  refuse_standard_input(path);
  std::error_code none;
  if (!fs::exists(path, none)) throw InputError(path.string() + ": no such file");
  if (fs::is_directory(path, none))
    throw InputError(path.string() +
                     ": is a directory, expected SWEEP.json; for its results use kds sweep status " +
                     path.string());
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw InputError(path.string() + ": cannot be read");
  return text.str();
}

void check_sweep_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(fmt::format("-o {}: is a file, expected a directory", folder.string()));
  if (!fs::exists(folder / kPlan, error) && !is_new(folder) && !fs::exists(folder / kPlan, error))
    throw InputError(fmt::format(
        "-o {}: holds other files and no sweep, expected a new folder or that of a sweep", folder.string()));
}

void keep_plan(const fs::path& folder, const Json& sweep, const fs::path& relative,
               const PatternFiles& files) {
  const std::string plan = plan_text(sweep, relative, files);
  std::error_code error;
  fs::create_directories(results_folder(folder), error);
  if (error) throw InputError(fmt::format("-o {}: {}", folder.string(), error.message()));
  if (fs::exists(folder / kPlan, error) && text_of_sweep(folder / kPlan) == plan) return;
  AtomicFiles written;
  written.write(folder / kPlan, plan);
  commit_together({&written});
}

KeptPlan kept_plan(const fs::path& folder) {
  std::error_code none;
  if (!fs::exists(folder / kPlan, none))
    throw InputError(fmt::format("{}: is no folder of a sweep (it has no {})", folder.string(), kPlan));
  KeptPlan kept;
  kept.subject = (folder / kPlan).string();
  const Json plan = read_json(text_of_sweep(kept.subject), kept.subject);
  const Json *const relative = plan.find("folder"), *const sweep = plan.find("sweep"),
                    *const files = plan.find("files");
  if (relative == nullptr || relative->text() == nullptr || sweep == nullptr)
    throw InputError(kept.subject +
                     ": expected the keys folder and sweep; run kds sweep SWEEP.json -o DIR again");
  kept.sweep = *sweep;
  kept.relative = *relative->text();
  if (files != nullptr) kept.files = *files;
  return kept;
}

}  // namespace kds
