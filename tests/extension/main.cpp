// The kds program with a user-defined structure and a user-defined reader. The tree's libraries do not know
// either of them.

#include "experiments/kds_main.h"
#include "tests/extension/nearest.h"
#include "tests/extension/table_reader.h"

int main(int argc, char** argv) {
  kds::structure_registry().add(extension::nearest_structure());
  kds::reader_registry().add(extension::table_reader());
  return kds::kds_main(argc, argv);
}
