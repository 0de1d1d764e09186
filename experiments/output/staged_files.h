#pragma once
// Files of a directory that appear together or not at all: they wait in a hidden folder of it, under numbers.
// Their names are kept there too, so that memory does not grow with the number of files.

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
  /// Makes the directory if it is not there. Throws InputError or OutputError naming option and path.
  /// `command` and `option` say whose results these are (result_manifest.h).
  StagedFiles(std::filesystem::path directory, std::string_view command, std::string_view option);
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Throws likewise. Throws InputError also if a file of that name is there that no earlier result of this
  /// kind wrote.
  void write(const std::string& name, std::string_view text);
  /// A file that is written piece by piece until finish(). Throws likewise.
  [[nodiscard]] std::ostream& open(const std::string& name);
  /// Throws where an open file could not be written.
  void check() const;

  /// Throws InputError if a file of the directory `belongs` to results of this kind and no earlier one
  /// wrote it.
  void refuse_others(const std::function<bool(std::string_view name)>& belongs) const;

  void finish() override;
  /// Removes the files that an earlier result of this kind wrote and this one does not have, unless they have
  /// changed since. If this is never called, no file is left, and a directory made is removed.
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
  std::optional<WrittenFile> names_;  ///< a line a file
  std::list<WrittenFile> open_;
  std::filesystem::path both_, manifest_;  ///< manifests in the making: with the earlier files, and without
};

}  // namespace kds
