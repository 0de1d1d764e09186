#pragma once
// Results that appear whole or not at all (atomic rename). A result waits in PLACE.part, a folder beside its
// place, until every result of the command is complete. PLACE.part is locked while it is in use, and is
// removed if the command fails. A killed program leaves it. The next result for that place says so and
// replaces it, unless it holds other files.

#include <filesystem>
#include <initializer_list>
#include <list>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

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
  bool replace = false;  ///< whether `out` may hold an earlier result, which is replaced
};

/// Throws OutputError if standard output is closed or full.
void print_to_stdout(const std::string& text);

/// Returns the absolute path with symbolic links followed, even if the path does not exist.
[[nodiscard]] std::filesystem::path place_of(const std::filesystem::path& path);
/// Returns whether `path` is `other` or a directory above it.
[[nodiscard]] bool leads_to(const std::filesystem::path& path, const std::filesystem::path& other);

/// Returns whether `path` is directly in `directory`, even if neither exists.
[[nodiscard]] bool lies_in(const std::filesystem::path& path, const std::filesystem::path& directory);

/// Checks before a run that a directory of results can be written after it. Leaves no trace. Throws an
/// InputError that names the option and the path, as AtomicFiles does.
void check_directory(const std::filesystem::path& path, std::string_view option, bool replace);

/// Throws InputError if another run writes to this directory of results now. Removes what a killed run has
/// left beside it.
void check_no_writer(const std::filesystem::path& path, std::string_view option);

/// Checks that `path` can be written later. Leaves no trace. Throws as check_directory does.
void ensure_writable_file(const std::filesystem::path& path, std::string_view option);

/// Checks --out and --json as check_directory and ensure_writable_file do.
void check_writable(const Destinations& destinations);

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

/// A file without a name, which is written piece by piece and copied at any time.
class UnnamedFile {
 public:
  /// Throws OutputError if the system provides no temporary file.
  UnnamedFile();
  [[nodiscard]] std::ostream& stream() { return stream_; }
  void check() const { stream_.check(); }
  /// Copies what has been written so far.
  void copy_to(std::ostream& other);

 private:
  OutputStream stream_;
};

struct PartFolder;  // PLACE.part

/// Files that are kept only if commit_together is called. Every function throws an InputError or OutputError
/// that names the path.
class AtomicFiles {
 public:
  /// For files in existing directories, each of which replaces the file at its place. A device, or a path
  /// that leads to a descriptor of this program (/dev/stdout, /dev/fd/3), is written directly.
  AtomicFiles();
  /// For the files of a directory, which is made with its parents. A directory that holds files is refused.
  /// If `replace`, it is replaced if kds wrote all its files and none has changed since. `option` is named in
  /// messages.
  AtomicFiles(const std::filesystem::path& directory, std::string_view option, bool replace);
  ~AtomicFiles();
  AtomicFiles(const AtomicFiles&) = delete;
  AtomicFiles& operator=(const AtomicFiles&) = delete;

  /// Writes a file. `place` is a path. In a directory it is a name, or the path of a file directly in it.
  void write(const std::filesystem::path& place, std::string_view text);
  /// Opens a file that is written piece by piece until the end.
  [[nodiscard]] std::ostream& open(const std::filesystem::path& place);
  /// Throws if a write to an open file failed, so that a long run can stop early.
  void check() const;
  /// For the files of a directory: moves them to their place and begins the next result, which will replace
  /// this one. If the place cannot be taken, because a file there has changed, drops the files and returns
  /// the reason.
  [[nodiscard]] std::optional<std::string> commit_and_begin_anew();

 private:
  friend void commit_together(std::initializer_list<AtomicFiles*> results);
  void finish();
  void take_places();

  bool is_directory_ = false, replace_ = false;
  std::string subject_;          ///< of a directory, for messages
  std::string names_;            ///< of the files in the directory, one on a line
  std::list<PartFolder> parts_;  ///< of the directory, or of each file
  std::list<OutputStream> open_;
};

/// Completes all files, and then moves the results to their places, one after the other. Skips null pointers.
void commit_together(std::initializer_list<AtomicFiles*> results);

}  // namespace kds
