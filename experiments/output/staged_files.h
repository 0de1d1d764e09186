#pragma once
// Files of a directory that appear together or not at all: they wait in a hidden folder of it, under numbers.
// What they will be called is kept there too, so that memory does not grow with them.

#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>

#include "experiments/output/made_directories.h"
#include "experiments/output/part.h"
#include "experiments/output/staged.h"
#include "experiments/output/written_file.h"

namespace kds {

class StagedFiles final : public Staged {
 public:
  /// Makes the directory if it is not there. Throws InputError or OutputError naming option and path.
  StagedFiles(std::filesystem::path directory, std::string_view option);
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Throws likewise.
  void write(const std::string& name, std::string_view text);
  /// A file that is written piece by piece until finish().
  [[nodiscard]] std::ostream& open(const std::string& name);
  /// Throws where an open file could not be written.
  void check() const;

  /// Files of the directory that belong to an earlier result go when those of this one take their places:
  /// these, too.
  void replace(std::function<bool(std::string_view name)> is_stale) {
    if (is_stale_) {
      is_stale_ = [before = std::move(is_stale_), more = std::move(is_stale)](std::string_view name) {
        return before(name) || more(name);
      };
    } else {
      is_stale_ = std::move(is_stale);
    }
  }

  void finish() override;
  /// Without it nothing is left, and a directory made goes too.
  void take_place() override;

 private:
  [[nodiscard]] std::filesystem::path place_for(const std::string& name);
  template <class Visit>
  void for_each(const Visit& visit) const;

  std::string subject_;
  std::filesystem::path directory_;
  MadeDirectories made_;
  Part folder_;
  std::optional<WrittenFile> names_;  ///< a line a file
  std::list<WrittenFile> open_;
  std::function<bool(std::string_view name)> is_stale_;
};

}  // namespace kds
