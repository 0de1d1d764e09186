#include "experiments/sweep/sweep_inputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

// Returns the path as sweep.json would give it.
std::string short_name(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return relative.empty() ? file.string() : relative.string();
}

std::vector<SweepInput> inputs_from(const SweptCommand& command, const Json& item, const fs::path& folder,
                                    PatternFiles& patterns, const std::string& where) {
  const Json* files = &item;
  std::vector<std::pair<std::string, AxisValue>> options;
  if (item.members() != nullptr) {
    files = item.find("file");
    if (files == nullptr)
      throw InputError(where +
                       ": an input that is an object needs the key 'file', beside options of the input");
    for (const auto& [key, value] : *item.members()) {
      if (key == "file") continue;
      const std::string name = known_option(command, key, where);
      for (const auto& [other, its_value] : options)
        if (other == name) throw InputError(fmt::format("{}: option {} is listed twice", where, name));
      options.emplace_back(
          name, read_value(command, name, value, folder, patterns, fmt::format("{}: {}", where, key)));
    }
  }
  std::vector<SweepInput> inputs;
  if (files->items() != nullptr) {  // several files of one task
    SweepInput input{{}, {}, options};
    std::vector<std::string> names;
    for (const Json& file : *files->items()) {
      names.push_back(scalar_text(file, where));
      if (names.back().empty()) throw InputError(where + ": 'file' lists an empty path");
      input.files.push_back(in_folder(folder, names.back()).string());
    }
    if (names.empty()) throw InputError(where + ": 'file' lists no file");
    input.name = fmt::format("{}", fmt::join(names, " "));
    return {input};
  }
  if (files->text() == nullptr || files->text()->empty())
    throw InputError(where + ": expected a path, or an object with the key 'file'");
  const std::string path = scalar_text(*files, where);
  const std::string whole = in_folder(folder, path).string();
  for (const std::string& file : patterns.of(path, folder, where))
    inputs.push_back({file == whole ? path : short_name(file, folder), {file}, options});
  return inputs;
}

}  // namespace

std::vector<SweepInput> read_inputs(const SweptCommand& command, const Json& json, const fs::path& folder,
                                    PatternFiles& files, const std::string& where) {
  if (json.items() == nullptr) return inputs_from(command, json, folder, files, where);
  std::vector<SweepInput> inputs;
  for (std::size_t k = 0; k < json.items()->size(); ++k)
    for (SweepInput& input :
         inputs_from(command, (*json.items())[k], folder, files, fmt::format("{}[{}]", where, k)))
      inputs.push_back(std::move(input));
  return inputs;
}

}  // namespace kds
