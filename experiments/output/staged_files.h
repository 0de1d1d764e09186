#pragma once
// Files of a directory that appear together or not at all. They wait in a hidden folder of the directory
// under numbers. Their names wait on disk too, so that memory does not grow with the number of files.

#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "experiments/output/made_directories.h"
#include "experiments/output/part.h"
#include "experiments/output/result_manifest.h"
#include "experiments/output/staged.h"
#include "experiments/output/written_file.h"

namespace kds {

class StagedFiles final : public Staged {
 public:
  /// Makes the directory if it does not exist. Throws an InputError or OutputError that names the option and
  /// the path. `command` and `option` identify the owner of these results (result_manifest.h).
  StagedFiles(std::filesystem::path directory, std::string_view command, std::string_view option);
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Writes a file. Throws as the constructor does. Throws InputError also if a file with that name exists
  /// that no earlier result of this kind wrote.
  void write(const std::string& name, std::string_view text);
  /// Opens a file that is written piece by piece until finish(). Throws as `write` does.
  [[nodiscard]] std::ostream& open(const std::string& name);
  /// Throws if a write to an open file failed.
  void check() const;

  /// Throws InputError if the directory has a file for which `belongs` is true but which no earlier result of
  /// this kind wrote.
  void refuse_others(const std::function<bool(std::string_view name)>& belongs) const;

  void finish() override;
  /// Moves all files to their places. Removes the files of an earlier result of this kind that are not in
  /// this one, unless they have changed since. If this is never called, no file remains, and a directory that
  /// the constructor made is removed.
  void take_place() override;

 private:
  [[nodiscard]] std::filesystem::path place_for(const std::string& name);
  template <class Visit>
  void for_each(const Visit& visit) const;

  std::string subject_;
  std::filesystem::path directory_;
  MadeDirectories made_;
  Part folder_;
  ResultManifest earlier_;
  std::optional<WrittenFile> names_;  ///< one name per line
  std::list<WrittenFile> open_;
  std::filesystem::path both_, manifest_;  ///< new manifests, with and without the earlier files
};

}  // namespace kds
