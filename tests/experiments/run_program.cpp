#include "tests/experiments/run_program.h"

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace kds::test {
namespace {

std::string drain(std::FILE* file) {
  std::string text;
  std::array<char, 4096> block;
  std::rewind(file);
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), file))
    text.append(block.data(), size);
  std::fclose(file);
  return text;
}

ProgramRun spawn(std::vector<std::string> words) {
  std::FILE* out = std::tmpfile();
  std::FILE* err = std::tmpfile();
  if (out == nullptr || err == nullptr) throw std::runtime_error("no temporary file");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", 0, 0);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(out), 1);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(err), 2);

  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, pointers.front(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot start " + words.front());

  int status = 0;
  rusage used{};
  ::wait4(child, &status, 0, &used);
  ProgramRun run;
  run.peak_kilobytes = used.ru_maxrss;
  if (WIFEXITED(status)) run.code = WEXITSTATUS(status);
  run.out = drain(out);
  run.err = drain(err);
  return run;
}

}  // namespace

ProgramRun run_program(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), KDS_PROGRAM);
  return spawn(std::move(arguments));
}

ProgramRun run_shell(const std::string& line, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"/bin/sh", "-c", line, KDS_PROGRAM});
  return spawn(std::move(arguments));
}

std::string data_file(const std::string& name) { return std::string(KDS_DATA_DIR) + "/" + name; }

}  // namespace kds::test
