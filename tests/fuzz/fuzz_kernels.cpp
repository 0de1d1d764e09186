// Fuzzes the kernels and structures with libFuzzer: kds_fuzz_kernels --target=NAME CORPUS... Whatever the
// scene that the bytes make, its run must have no fault (kernel_targets.h).

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/fuzz/kernel_targets.h"

namespace {

const kds::test::FuzzTarget* target = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  constexpr std::string_view option = "--target=";
  for (int i = 1; i < *count; ++i)
    if (const std::string_view argument = (*arguments)[i]; argument.starts_with(option))
      target = kds::test::find_target(argument.substr(option.size()));
  if (target != nullptr) return 0;
  std::fprintf(stderr, "expected --target= and kernels, audits, contacts or crossings\n");
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const auto scene = target->scene_of({reinterpret_cast<const char*>(bytes), size});
  if (const auto fault = target->fault_of(scene)) {
    std::fprintf(stderr, "%s: %s\n", scene.structure.title().c_str(), fault->c_str());
    std::abort();
  }
  return 0;
}
