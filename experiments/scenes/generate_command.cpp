#include "experiments/program/commands.h"

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <utility>

#include "experiments/output/output_files.h"
#include "experiments/program/table_command.h"
#include "experiments/scenes/generate_options.h"
#include "experiments/scenes/info_report.h"
#include "motions/base/input_error.h"
#include "motions/models/shape.h"
#include "motions/readers/write_trajectory.h"

namespace kds {

namespace {

namespace fs = std::filesystem;

// Returns one file per necklace. For two necklaces, a.xyz becomes a-1.xyz and a-2.xyz.
std::vector<fs::path> files_of(const GenerateOptions& options) {
  if (options.model->name != "two-spirals") return {options.file};
  std::vector<fs::path> files;
  for (const char* suffix : {"-1", "-2"}) {
    fs::path name = options.file.stem();
    name += suffix;
    name += options.file.extension();
    files.push_back(options.file.parent_path() / name);
  }
  return files;
}

std::string command_line(const GenerateOptions& options) {
  std::string text = fmt::format("kds generate {}", options.model->name);
  for (const auto& [name, value] : model_settings(options)) text += fmt::format(" --{} {}", name, value);
  return text;
}

// Refuses to replace a-1.xyz and a-2.xyz, which the user did not name, unless kds generate wrote them.
void refuse_unnamed(const GenerateOptions& options, const fs::path& file) {
  std::error_code error;
  if (file == options.file || !fs::exists(file, error)) return;
  std::ifstream there(file, std::ios::binary);
  std::string start(200, '\0');
  there.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start.find("kds generate ") == std::string::npos)
    throw InputError(
        fmt::format("-o {}: {} is there and was not written by kds generate; move it or give another FILE",
                    options.file.string(), file.string()));
}

// Completes all files before the first takes its place.
void write_files(const GenerateOptions& options, const std::vector<Trajectory>& necklaces) {
  AtomicFiles files;
  for (const Trajectory& necklace : necklaces) {
    std::ostream& file = files.open(necklace.file);
    if (options.is_pdb()) {
      write_pdb(file, necklace, command_line(options));
    } else {
      write_xyz(file, necklace, command_line(options));
    }
  }
  commit_together({&files});
}

// Returns the necklaces as a reader of the files will get them.
std::vector<Trajectory> necklaces_for(const GenerateOptions& options, const std::vector<fs::path>& files) {
  std::vector<Trajectory> necklaces = generate(*options.model, options.settings);
  for (std::size_t n = 0; n < necklaces.size(); ++n) {
    const std::string file = files[n].string();
    if (options.is_pdb()) necklaces[n] = as_in_pdb(necklaces[n], file);
    necklaces[n].file = file;
  }
  return necklaces;
}

void deliver(const GenerateOptions& options, const SceneInfo& info, const TableCommand& command) {
  Json json;
  json["model"] = options.model->name;
  add_scene(json, info);
  json["settings"] = Json::object();
  std::string table = fmt::format("model     {}", options.model->name);
  for (const auto& [name, value] : model_settings(options)) {
    json["settings"][name] = value;
    table += fmt::format(", {} {}", name, value);
  }
  command.deliver(json, conditions_csv(info), table + "\n" + scene_table(info));
}

}  // namespace

int generate_command(const Arguments& arguments) {
  const GenerateOptions options = parse_generate_options(arguments);
  TableCommand command("generate", arguments, options, "frame");
  const std::vector<fs::path> files = files_of(options);
  TakenPaths taken;
  for (const fs::path& file : files) {
    ensure_writable_file(file, "-o");
    refuse_unnamed(options, file);
    taken.add("-o", file);
  }
  command.check_destinations(taken, {"generate.json", "generate.csv"});

  const std::vector<Trajectory> necklaces = necklaces_for(options, files);
  std::size_t beads = 0;
  for (const Trajectory& necklace : necklaces) beads += necklace.bead_count();
  const std::vector<double> radii(beads, models::radius);
  const SceneInfo info = describe_scene(necklaces, radii, {.most_listed = 5}, command.progress());
  command.bar().erase();
  write_files(options, necklaces);
  deliver(options, info, command);
  return 0;
}

}  // namespace kds
