// Measures how long contacts of residues last, in a run of one's own: the run's events make exact intervals,
// and the intervals make statistics. FILE is PDB, mmCIF or XYZ, and names residues.
#include <cstdio>
#include <span>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"
#include "structures/contacts/contact_elements.h"
#include "structures/contacts/contact_lifetimes.h"
#include "structures/contacts/contacts.h"
#include "structures/session/kinetic_run.h"

namespace {

void measure(const char* file) {
  kds::ReadOptions options;
  options.selection = kds::Selection::ca;
  const kds::Trajectory necklace = kds::read_trajectory(file, options);
  const std::span necklaces(&necklace, 1);
  const kds::Scene scene(necklaces, kds::bead_radii("auto", necklaces));
  const auto residues = kds::elements_of(scene, kds::ContactElement::residue);

  // Residues are in contact within 8 angstrom, and at least 3 apart along the chain.
  kds::KineticRun run(scene, {.by_default = false});
  const auto& contacts = run.add<kds::Contacts<3>>(kds::PairsAsked{scene.necklaces(), true, 3, true},
                                                   kds::contact_radii({.length = 8}, scene.radii()));
  kds::ContactLifetimes lifetimes;
  // An absence shorter than half a frame does not end a contact.
  kds::ContactIntervals intervals(
      run.simulator(), {.elements = residues.of_bead, .chains = residues.chains, .apart = 3, .gap = 0.5},
      [&](const kds::ContactInterval& interval) { lifetimes.add(interval); });
  run.listen(intervals);
  run.build();
  intervals.add_built(contacts.pairs(), contacts.pairs(), scene.stamp(0), scene.stamp(1));
  run.finish();  // runs all steps
  const std::size_t last = scene.step_count() - 1;
  intervals.finish(last, scene.stamp(last), scene.stamp(last + 1));

  const auto length = static_cast<double>(scene.step_count());
  const kds::LifetimeFigures all = lifetimes.all(length);
  std::printf("%d contacts of %d pairs, mean life %.3f frames, median %.3f\n", static_cast<int>(all.contacts),
              static_cast<int>(lifetimes.pair_count()), all.mean(), all.median);
  kds::PairLifetimes busiest;
  lifetimes.visit_pairs(length, [&](const kds::PairLifetimes& pair) {
    if (pair.contacts > busiest.contacts) busiest = pair;
  });
  std::printf("%s and %s: %d contacts, %.1f%% of the time\n", residues.names[busiest.first].c_str(),
              residues.names[busiest.second].c_str(), static_cast<int>(busiest.contacts),
              100 * busiest.occupancy());
  for (const kds::SurvivalPoint& point : lifetimes.survival()) {
    if (point.survival > 0.5) continue;
    std::printf("half of the contacts last longer than %.3f frames\n", point.length);
    break;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: contact_lifetimes FILE\n");
    return 2;
  }
  try {
    measure(argv[1]);
  } catch (const kds::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
