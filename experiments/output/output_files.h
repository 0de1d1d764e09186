#pragma once
// Output files that appear whole or not at all (atomic rename): each waits in a hidden folder next to its
// place until every result of the command is complete, then it is renamed. The hidden folder,
// .kds-PROCESS-NUMBER.part, is removed at the end and if a signal ends the program. If the program is killed,
// the next run that writes there removes the folder.

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <list>
#include <optional>
#include <ostream>
#include <span>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/output/result_manifest.h"
#include "experiments/output/unfinished_folder.h"

namespace kds {

/// A result cannot be written although the request was valid, for instance because the disk or the pipe is
/// full. The program prints the message and exits with code 1.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws an error with the message "`subject`: reason", where the reason is the system's text for `error` (a
/// value of errno). A place that cannot be written to is an InputError. Every other reason is an OutputError.
[[noreturn]] void fail_to_write(const std::string& subject, int error);

/// The destinations of a command's results: files, standard output and the table on the terminal.
struct Destinations {
  std::optional<std::filesystem::path> out;  ///< directory for the result files
  std::optional<std::string> json;           ///< a file, or - for standard output
  bool quiet = false;
  bool paper = false;  ///< whether `out` also gets files for a paper (page/paper.h)
};

/// Throws OutputError if standard output is closed or full.
void print_to_stdout(const std::string& text);

/// Checks before a run that the results can be written after it: that the directory exists or can be made,
/// and that the command can write files with these names in it. Leaves no trace. Throws an InputError that
/// names the option and the path.
void check_directory(const std::filesystem::path& path, std::string_view command, std::string_view option,
                     std::initializer_list<std::string_view> names = {});

/// Checks that `path` can be written later. Leaves no trace. Throws as check_directory does.
void ensure_writable_file(const std::filesystem::path& path, std::string_view option);

/// A stream into an open file descriptor. Unlike std::ofstream, it remembers why a write failed.
class OutputStream final : public std::ostream {
 public:
  /// Takes an open descriptor. `subject` begins the messages, which are thrown as fail_to_write does.
  OutputStream(int descriptor, std::string subject);
  ~OutputStream() override;

  [[nodiscard]] int descriptor() const { return buffer_.descriptor; }
  void check() const;  ///< throws if a write failed
  void close();        ///< completes the file

 private:
  struct Buffer final : std::streambuf {
    explicit Buffer(int number);
    int_type overflow(int_type c) override;
    int sync() override;

    int descriptor;
    int error = 0;  ///< errno of the first write that failed; later writes are not attempted
    std::vector<char> bytes;
  };

  std::string subject_;
  Buffer buffer_;
};

struct StagingFolder;  // the hidden folder next to some results

/// Files that appear together or not at all. Without commit_together nothing remains, even if a signal ends
/// the program. Every function throws an InputError or OutputError that names the path.
class AtomicFiles {
 public:
  /// For files in existing directories. A device, or a path that leads to a descriptor of this program
  /// (/dev/stdout, /dev/fd/3), is written directly.
  AtomicFiles();
  /// For the files of a directory, which is made with its parents if it does not exist. `command` and
  /// `option` identify the owner of these results (result_manifest.h). The files of an earlier result of this
  /// owner are replaced or removed, unless they have changed since. All other files stay, and a result with
  /// the name of such a file is refused.
  AtomicFiles(std::filesystem::path directory, std::string_view command, std::string_view option);
  ~AtomicFiles();
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;

  /// Writes a file. `place` is a path, or a name in the directory.
  void write(const std::filesystem::path& place, std::string_view text);
  /// Opens a file that is written piece by piece until the end.
  [[nodiscard]] std::ostream& open(const std::filesystem::path& place);
  /// Throws if a write to an open file failed, so that a long run can stop early.
  void check() const;
  /// Throws InputError if the directory has a file for which `belongs` is true but which no earlier result of
  /// this owner wrote.
  void refuse_others(const std::function<bool(std::string_view name)>& belongs) const;

 private:
  friend void commit_together(std::initializer_list<AtomicFiles*> results);
  struct File {
    std::string waiting, place;  ///< paths, as texts because there may be a file for each frame
  };

  void finish();
  void take_places();
  StagingFolder& folder_in(const std::filesystem::path& directory, const std::string& subject);

  std::filesystem::path directory_;
  std::string subject_;
  std::list<UnfinishedFolder> made_;  ///< the directory and its parents, in the order of removal
  std::list<StagingFolder> folders_;
  std::optional<ResultManifest> earlier_;
  std::vector<File> files_;
  std::list<OutputStream> open_;
  std::filesystem::path both_, manifest_;  ///< new manifests, with and without the earlier files
};

/// Completes all files and checks every condition for their moves that can be known beforehand. Moves all
/// files to their places, with signals blocked. Skips null pointers.
void commit_together(std::initializer_list<AtomicFiles*> results);

}  // namespace kds
