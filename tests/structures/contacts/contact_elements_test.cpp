#include "structures/contacts/contact_elements.h"

#include <gmock/gmock.h>

#include <vector>

#include "motions/base/input_error.h"
#include "structures/session/kinetic_run.h"
#include "tests/support/inputs/moving_beads.h"

namespace kds::contact_elements_test {
namespace {

using namespace test;
using testing::ElementsAre;

Trajectory villin() {
  ReadOptions options;
  options.topology = data("trajectories/villin_hp36_300K.pdb");
  options.frames.last = 2;
  return read_trajectory(data("trajectories/villin_hp36_300K.dcd"), options);
}

Scene scene_of(const std::vector<Trajectory>& necklaces) {
  std::size_t beads = 0;
  for (const Trajectory& necklace : necklaces) beads += necklace.bead_count();
  return Scene(necklaces, std::vector<double>(beads, 1));
}

TEST(ContactElements, ResiduesAreRunsOfBeads) {
  const Scene scene = scene_of({villin()});
  const ContactElements residues = elements_of(scene, ContactElement::residue);
  ASSERT_EQ(residues.names.size(), 36U);
  ASSERT_EQ(residues.of_bead.size(), 108U);
  EXPECT_EQ(residues.of_bead[2], 0U);
  EXPECT_EQ(residues.of_bead[3], 1U);
  EXPECT_EQ(residues.of_bead[107], 35U);
  EXPECT_EQ(residues.names[0], "MET 41");
  EXPECT_EQ(elements_of(scene, ContactElement::bead).names[4], scene.bead_name(4));
  EXPECT_EQ(elements_of(scene, ContactElement::bead).names.size(), 108U);
}

TEST(ContactElements, OfTwoNecklacesHaveOtherNames) {
  const Scene scene = scene_of({villin(), villin()});
  const ContactElements residues = elements_of(scene, ContactElement::residue);
  ASSERT_EQ(residues.names.size(), 72U);
  EXPECT_EQ(residues.chains[35], 0U);
  EXPECT_EQ(residues.chains[36], 1U);
  EXPECT_EQ(residues.of_bead[108], 36U);
  const ContactElements chains = elements_of(scene, ContactElement::chain);
  EXPECT_THAT(chains.names, ElementsAre("necklace 0", "necklace 1"));  // the file has one name for both
  EXPECT_EQ(chains.of_bead[107], 0U);
  EXPECT_EQ(chains.of_bead[108], 1U);
}

TEST(ContactElements, BeadsWithoutResiduesHaveNone) {
  Trajectory unnamed = villin();
  unnamed.bead_names.clear();
  const Scene scene = scene_of({unnamed});
  EXPECT_EQ(elements_of(scene, ContactElement::bead).names[3], "bead 3");
  EXPECT_THROW(static_cast<void>(elements_of(scene, ContactElement::residue)), InputError);
}

// Between centres, a run follows the balls of half the distance, whatever the radii of the scene.
TEST(ContactDistance, IsThatOfBallsInARun) {
  const Trajectory trajectory =
      read_trajectory(data("trajectories/random100_400K_first200.dcd"), {.frames = {0, 20}});
  const auto fingerprint = [&](double radius, std::optional<ContactDistance> distance) {
    const Scene scene(std::span(&trajectory, 1), std::vector<double>(trajectory.bead_count(), radius));
    KineticRunOptions options{{"contacts"}, Kernel::filtered, AuditMode::frames};
    options.settings.contact_distance = distance;
    KineticRun run(scene, options);
    run.finish();
    return run.simulator().fingerprint();
  };
  const auto balls = fingerprint(2.25, {});
  EXPECT_EQ(fingerprint(1, ContactDistance{4.5, false}), balls);
  EXPECT_EQ(fingerprint(1.75, ContactDistance{1, true}), balls);
  EXPECT_NE(fingerprint(1.75, ContactDistance{1, false}), balls);
}

}  // namespace
}  // namespace kds::contact_elements_test
