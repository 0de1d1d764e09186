// Makes a scene that has a fault as small as possible, and writes it as files that `kds run` reads:
//
//   kds_minimize TARGET PREFIX INPUT                       an input of kds_fuzz_kernels
//   kds_minimize TARGET PREFIX FILE STRUCTURE [RADIUS]     an instance file, or a trajectory of one necklace
//
// TARGET is one of kernel_targets.h. The files are PREFIX.txt, an instance, or PREFIX.0.xyz ... and
// PREFIX.radii. Prints the fault and the commands that run the scene. Exits with 1 if there is no fault.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "tests/fuzz/kernel_targets.h"
#include "tests/fuzz/minimize.h"

namespace {

using namespace kds;
using namespace kds::test;

[[noreturn]] void refuse(const std::string& message) {
  fmt::print(stderr, "kds_minimize: {}\n", message);
  std::exit(2);
}

SmallScene read(const FuzzTarget& target, const std::vector<std::string>& arguments) {
  if (arguments.size() == 3) return target.scene_of(read_whole_file(arguments[2]));
  if (!target.structure.empty())
    refuse(fmt::format("{} takes inputs of kds_fuzz_kernels only; for files use kernels or audits",
                       target.name));
  const auto radius = arguments.size() == 5 ? parse_double(arguments[4]) : 0.0;
  if (!radius) refuse(fmt::format("expected a number as RADIUS, found '{}'", arguments[4]));
  SmallScene scene = read_scene(arguments[2], *radius);
  const auto row = std::ranges::find(law_structures(), arguments[3], &LawStructure::title);
  if (row == law_structures().end()) {
    std::vector<std::string> titles;
    for (const LawStructure& other : law_structures()) titles.push_back(other.title());
    refuse(fmt::format("no structure '{}'; expected one of: {}", arguments[3], fmt::join(titles, ", ")));
  }
  scene.structure = *row;
  return scene;
}

int minimize(const std::vector<std::string>& arguments) {
  const FuzzTarget* const target = arguments.empty() ? nullptr : find_target(arguments[0]);
  if (target == nullptr || arguments.size() < 3 || arguments.size() > 5)
    refuse(
        "expected kernels, audits, contacts or crossings, then PREFIX INPUT or PREFIX FILE STRUCTURE "
        "[RADIUS]");
  SmallScene scene = read(*target, arguments);
  if (!target->fault_of(scene)) {
    fmt::print("no fault within the limit of exact work\n");
    return 1;
  }
  scene = minimized(std::move(scene), [&](const SmallScene& s) { return target->fault_of(s).has_value(); });
  const std::string title = scene.structure.title(), fault = *target->fault_of(scene);
  const std::string command = fmt::format("kds {}", fmt::join(write_scene(scene, arguments[1]), " "));
  fmt::print("{}: {}\n", title, fault);
  if (target->name == "kernels") {
    fmt::print("{0} --kernel filtered\n{0} --kernel exact\n", command);
  } else {
    fmt::print("{} --audit events\n", command);
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return minimize({arguments + 1, arguments + count});
  } catch (const InputError& error) {
    refuse(error.what());
  }
}
