// Random arguments of `kds run`, `kds generate`, `kds info`, `kds update` and `kds collide` give options,
// help, or a single line of error.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "experiments/collide/collide_command.h"
#include "experiments/output/text.h"
#include "experiments/run/run_options.h"
#include "experiments/scenes/generate_command.h"
#include "experiments/scenes/info_command.h"
#include "experiments/update/update_command.h"
#include "motions/base/input_error.h"
#include "tests/support/rounds.h"

namespace kds::parse_options_fuzz_test {
namespace {

const std::vector<std::string> kWords = split(
    "--beads|--frames|--seed|--motion|--step|--bond|--turns|--pitch|--gap|--dimension|--fill|"
    "--rolled|--jitter|--distance|-o|--out|--json|--quiet|--help|-h|--|-||=|---|--quiet=|helix|"
    "spline|spiral|grid|two-spirals|random-chain|a.xyz|b.pdb|c.dcd|.xyz|a.xyz/|0|1|2|100|0.5|0.999|"
    "-0.5|1e400|-1e-400|nan|inf|0:1|:|0:1:2|1e3:|rest|rotate|wander|--topology|--select|--chain|"
    "--radius|--rho|--list|all|auto|element:fit|::2|18446744073709551616|-3|{}|[a,b]|\"|a b|\n|"
    "\xff\xfe|--beads=10|-oa.xyz|-o=a.xyz|--rho=2|%%|--techniques|--strides|--rounds|--audit|frames|"
    "kinetic,lifted|rebuild,|1,2,4|2,2|--method|--pairs|--apart|wrapped,brute|between|--structures|"
    "--kernel|--levels|--nodes|--dump|--log|++|--=|power|wrapped|sorted|contacts|linear|hermite|"
    "filtered|exact|backbone|ca|none|events|element|file:|file:r.txt|0:200|5:1:1|a.pdb|b.dcd|[|'x|"
    "--kernel=|--kernel=exact|--json=-|--radius=1|-vvv|-1|/opt|18446744073709551616:|--config|"
    "--groups",
    '|');

std::string random_word(std::mt19937& random) {
  std::string word = kWords[random() % kWords.size()];
  switch (random() % 8) {
    case 0:
      return word + kWords[random() % kWords.size()];
    case 1:
      return word + "," + kWords[random() % kWords.size()];
    case 2:
      for (char& c : word)
        if (random() % 4 == 0) c = static_cast<char>(1 + random() % 255);
      return word;
    default:
      return word;
  }
}

struct Outcomes {
  std::size_t accepted = 0, refused = 0, helped = 0;
};

template <class Parse>
void fuzz(const std::vector<Arguments>& starts, Parse&& parse) {
  std::mt19937 random(20040614);
  Outcomes outcomes;
  for (int round = 0; round < test::rounds(6000); ++round) {
    Arguments arguments = starts[random() % starts.size()];
    const std::size_t more = random() % 6;
    for (std::size_t i = 0; i < more; ++i) {
      const std::size_t place = random() % (arguments.size() + 1);
      arguments.insert(arguments.begin() + static_cast<std::ptrdiff_t>(place), random_word(random));
    }
    try {
      parse(arguments);
      ++outcomes.accepted;
    } catch (const HelpRequest& help) {
      EXPECT_FALSE(help.text.empty());
      ++outcomes.helped;
    } catch (const InputError& error) {
      EXPECT_FALSE(one_line(error.what()).empty());
      ++outcomes.refused;
    }
  }
  EXPECT_GT(outcomes.accepted, test::rounds(100U));
  EXPECT_GT(outcomes.refused, test::rounds(1000U));
  EXPECT_GT(outcomes.helped, test::rounds(100U));
}

TEST(RunOptionsFuzz, OnlyOptionsHelpOrOneRefusalComeOut) {
  fuzz({{}, {"a.pdb"}, {"a.pdb", "--structures", "power,contacts", "b.dcd"}},
       [](const Arguments& arguments) { EXPECT_FALSE(parse_run_options(arguments).inputs.empty()); });
}

TEST(GenerateOptionsFuzz, OnlyOptionsHelpOrOneRefusalComeOut) {
  fuzz({{}, {"grid", "--beads", "10", "-o", "a.xyz"}, {"two-spirals", "-o", "a.pdb", "--beads", "3"}},
       [](const Arguments& arguments) {
         const GenerateOptions options = parse_generate_options(arguments);
         const models::Settings& s = options.settings;
         EXPECT_TRUE(s.beads >= 2 && s.frames >= 1 && s.beads * s.frames <= 100'000'000);
         EXPECT_FALSE(options.file.empty());
         EXPECT_TRUE(!s.step || (std::isfinite(*s.step) && *s.step >= 0));
         EXPECT_TRUE(!s.rolled || (s.rolled->first >= 0 && s.rolled->last <= 1));
         for (const auto& [name, value] : model_settings(options)) EXPECT_FALSE(value.empty()) << name;
       });
}

TEST(InfoOptionsFuzz, OnlyOptionsHelpOrOneRefusalComeOut) {
  fuzz({{}, {"a.xyz"}, {"a.xyz", "--rho", "2"}}, [](const Arguments& arguments) {
    const InfoOptions options = parse_info_options(arguments);
    EXPECT_FALSE(options.inputs.empty());
    EXPECT_GE(options.validate.rho, 1);
  });
}

TEST(UpdateOptionsFuzz, OnlyOptionsHelpOrOneRefusalComeOut) {
  fuzz({{}, {"a.xyz"}, {"a.xyz", "--strides", "1,8"}}, [](const Arguments& arguments) {
    const UpdateOptions options = parse_update_options(arguments);
    EXPECT_FALSE(options.inputs.empty());
    EXPECT_EQ(options.techniques.front(), "rebuild");
    EXPECT_FALSE(options.strides.empty());
    EXPECT_GE(options.strides.front(), 1U);
    EXPECT_GE(options.rounds, 1U);
  });
}

TEST(CollideOptionsFuzz, OnlyOptionsHelpOrOneRefusalComeOut) {
  fuzz({{}, {"a.xyz"}, {"a.xyz", "--apart", "5", "--method", "power"}}, [](const Arguments& arguments) {
    const CollideOptions options = parse_collide_options(arguments);
    EXPECT_FALSE(options.inputs.empty());
    EXPECT_FALSE(options.methods.empty());
    EXPECT_GE(options.apart, 1U);
  });
}

}  // namespace
}  // namespace kds::parse_options_fuzz_test
