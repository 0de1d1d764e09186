#pragma once
// A result must not replace what it was computed from, nor another result.

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/output/destinations.h"
#include "experiments/program/input_options.h"

namespace kds {

class TakenPaths {
 public:
  /// A file that is read, or written by someone else; `owner` names it in messages.
  void add(std::string owner, const std::filesystem::path& path) {
    taken_.emplace_back(std::move(owner), path);
  }
  /// The files that are read.
  void read(const InputOptions& options);
  /// All files in a folder, of which some are read.
  void read_folder(const std::string& owner, const std::filesystem::path& folder);
  /// What --json says: a file as `write` has it, or - for standard output, which may be a file too.
  void write_json(const std::string& destination);
  /// A file to be written. Throws InputError where it is another's, or is to be a directory; devices are for
  /// all.
  void write(const std::string& option, const std::filesystem::path& path);
  /// A directory, and files of these names to be written there. Throws InputError likewise, and where the
  /// directory, or one that it is to be made in, is to be a file.
  void write_into(const std::string& option, const std::filesystem::path& directory,
                  std::initializer_list<std::string_view> names = {});
  /// The files that `deliver` writes.
  void write(const Destinations& destinations);

 private:
  std::vector<std::pair<std::string, std::filesystem::path>> taken_, directories_;
};

}  // namespace kds
