// A structure of one's own in the Python module: registers `nearest` before the module is used.
// CMake takes this file by -DKDS_PYTHON_EXTENSIONS.
#include "structures/session/structure_spec.h"
#include "tests/extension/nearest.h"

namespace {

[[maybe_unused]] const bool added = [] {
  kds::structure_registry().add(extension::nearest_structure());
  return true;
}();

}  // namespace
