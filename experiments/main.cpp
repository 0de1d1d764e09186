// The kds program.

#include "experiments/kds_main.h"

int main(int argc, char** argv) { return kds::kds_main(argc, argv); }
