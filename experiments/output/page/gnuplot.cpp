#include "experiments/output/page/gnuplot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "experiments/output/output_files.h"
#include "experiments/output/text.h"
#include "motions/base/input_error.h"

namespace kds {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using Stream = std::unique_ptr<std::FILE, Close>;

// Files in memory are used instead of pipes: they cannot deadlock, raise SIGPIPE or fill a disk.
Stream nameless_file() {
  const int descriptor = ::memfd_create("kds", MFD_CLOEXEC);
  Stream file(descriptor < 0 ? nullptr : ::fdopen(descriptor, "w+"));
  if (!file) fail_to_write("gnuplot: cannot make a file in memory", errno);
  return file;
}

std::string content_of(std::FILE* file) {
  std::string text;
  std::array<char, 65536> block;
  std::rewind(file);
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), file))
    text.append(block.data(), size);
  return text;
}

struct Outcome {
  int status = 0;  ///< the status of waitpid
  std::string output, errors;
};

Outcome spawn_gnuplot(const std::string& script) {
  const Stream input = nameless_file(), output = nameless_file(), errors = nameless_file();
  if (std::fwrite(script.data(), 1, script.size(), input.get()) != script.size() ||
      std::fflush(input.get()) != 0)
    fail_to_write("gnuplot: cannot write its script", errno);
  std::rewind(input.get());

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(input.get()), 0);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(output.get()), 1);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(errors.get()), 2);
  std::string name = "gnuplot", plain = "--default-settings";  // ignores the user's start-up file
  const std::array<char*, 3> arguments{name.data(), plain.data(), nullptr};
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("gnuplot: " + std::generic_category().message(failed));

  Outcome outcome;
  while (::waitpid(child, &outcome.status, 0) < 0 && errno == EINTR) {
  }
  outcome.output = content_of(output.get());
  outcome.errors = content_of(errors.get());
  return outcome;
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  Outcome outcome = spawn_gnuplot(script);
  if (!WIFEXITED(outcome.status) || WEXITSTATUS(outcome.status) != 0 || outcome.output.empty())
    throw std::runtime_error("gnuplot failed: " + one_line(outcome.errors));
  return std::move(outcome.output);
}

void require_gnuplot(std::string_view option) {
  std::string why;
  try {
    static_cast<void>(run_gnuplot("set terminal svg\nset print '-'\nprint 'ready'\n"));
    return;
  } catch (const OutputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    why = error.what();
  }
  throw InputError(
      fmt::format("{} needs gnuplot for its plots (Debian package gnuplot-nox): {}", option, why));
}

}  // namespace kds
