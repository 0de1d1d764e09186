// Registers the structure `nearest` of tests/extension/ when the Python module is loaded. The CMake option
// KDS_PYTHON_EXTENSIONS takes this file.
#include "structures/session/structure_spec.h"
#include "tests/extension/nearest.h"

namespace {

[[maybe_unused]] const bool added = [] {
  kds::structure_registry().add(extension::nearest_structure());
  return true;
}();

}  // namespace
