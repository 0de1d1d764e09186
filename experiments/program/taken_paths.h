#pragma once
// Refuses outputs that would replace an input or another output of the same command.

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/program/input_options.h"

namespace kds {

class TakenPaths {
 public:
  /// Registers a file that is read, or that another part of the program writes. `owner` names it in messages.
  void add(std::string owner, const std::filesystem::path& path) {
    taken_.emplace_back(std::move(owner), path);
  }
  /// Registers the files that are read.
  void read(const InputOptions& options);
  /// Registers all files in a folder from which some are read.
  void read_folder(const std::string& owner, const std::filesystem::path& folder);
  /// Registers the destination of --json: a file, as `write` does, or - for standard output, which may itself
  /// be redirected to a file.
  void write_json(const std::string& destination);
  /// Registers a file that will be written. Throws InputError if the file is already registered or must be a
  /// directory for another result. Devices may be shared.
  void write(const std::string& option, const std::filesystem::path& path);
  /// Registers a directory and files with these names that will be written in it. Throws InputError as
  /// `write` does, and also if the directory or one of its parents is registered as a file.
  void write_into(const std::string& option, const std::filesystem::path& directory,
                  std::initializer_list<std::string_view> names = {});
  /// Registers the files that `deliver` writes.
  void write(const Destinations& destinations);

 private:
  std::vector<std::pair<std::string, std::filesystem::path>> taken_, directories_;
};

}  // namespace kds
