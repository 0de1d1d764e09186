// The pressure of hard spheres (hard_spheres.h), compared with the equation of Carnahan and Starling.
#include "examples/hard_spheres.h"

#include <cinttypes>
#include <cstdio>
#include <ctime>
#include <string>

/// Prints the compressibility factor Z = pV / NkT and its standard error, from 20 parts of the run.
static void measure(int side, double packing, int collisions) {
  if (collisions < 1) throw std::invalid_argument("the number of collisions: expected 1 or more");
  constexpr int parts = 20;
  HardSpheres balls(side, packing, 0.05);
  const double energy = balls.energy(), n = static_cast<double>(balls.count());
  const std::clock_t start = std::clock();
  while (balls.collisions < 20 * balls.count()) balls.step();  // melts the lattice
  const std::size_t melted = balls.collisions;
  double sum = 0, squares = 0;
  for (int part = 1; part <= parts; ++part) {
    const double virial = balls.virial, time = balls.time;
    do balls.step();
    while (balls.collisions < melted + std::size_t{1} * collisions * part / parts);
    // The energy is 3/2 (N - 1) kT, because the sum of all momenta is 0.
    const double z = 1 + (n - 1) / n * (balls.virial - virial) / (2 * energy * (balls.time - time));
    sum += z;
    squares += z * z;
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, mean = sum / parts;
  const double empty = 1 - packing,
               known = (1 + packing + packing * packing * empty) / (empty * empty * empty);
  std::printf("%zu balls, %zu collisions, energy changed by %.1e, fingerprint %016" PRIx64 "\n",
              balls.count(), balls.collisions, balls.energy() / energy - 1, balls.simulator().fingerprint());
  std::printf("Z = %.4f, standard error %.4f, Carnahan-Starling %.4f\n", mean,
              std::sqrt((squares / parts - mean * mean) / (parts - 1)), known);
  std::printf("%.0f collisions per second of processor time\n", balls.collisions / seconds);
}

int main(int argc, char** argv) {
  try {
    measure(argc > 1 ? std::stoi(argv[1]) : 4, argc > 2 ? std::stod(argv[2]) : 0.3,
            argc > 3 ? std::stoi(argv[3]) : 4000);
  } catch (const std::exception& error) {
    std::fprintf(stderr,
                 "hard_spheres: %s\nusage: hard_spheres [CELLS [PACKING [COLLISIONS]]], such as 4 0.3 4000\n",
                 error.what());
    return 2;
  }
}
