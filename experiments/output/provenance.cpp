#include "experiments/output/provenance.h"

#include <sys/utsname.h>

#include <fstream>
#include <thread>

#include "version.h"

namespace kds {
namespace {

// Returns the value of the first line `key<separator>value`, without quotes and blanks around it.
std::string look_up(const char* file, const std::string& key, char separator) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t place = line.find(separator);
    const std::size_t first = line.find_first_not_of(" \t\"", place == std::string::npos ? place : place + 1);
    if (first == std::string::npos) continue;
    return line.substr(first, line.find_last_not_of(" \t\"\r") + 1 - first);
  }
  return {};
}

std::string operating_system() {
  utsname names{};
  if (::uname(&names) != 0) return "unknown";
  const std::string kernel = std::string(names.sysname) + " " + names.release + " " + names.machine;
  const std::string distribution = look_up("/etc/os-release", "PRETTY_NAME", '=');
  return distribution.empty() ? kernel : distribution + ", " + kernel;
}

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown";
#endif
}

}  // namespace

std::string program_version() { return KDS_VERSION "+" KDS_COMMIT; }

Machine this_machine() {
  const std::string cpu = look_up("/proc/cpuinfo", "model name", ':');
  return {cpu.empty() ? "unknown" : cpu, std::thread::hardware_concurrency(), operating_system(), compiler()};
}

}  // namespace kds
