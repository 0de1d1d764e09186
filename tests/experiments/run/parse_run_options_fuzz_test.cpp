// For random arguments the parser returns options, help, or one line that explains the mistake.

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "experiments/output/text.h"
#include "experiments/run/run_options.h"
#include "motions/base/input_error.h"
#include "tests/support/rounds.h"

namespace kds::parse_run_options_fuzz_test {
namespace {

constexpr std::array kWords{"--structures",
                            "--motion",
                            "--kernel",
                            "--levels",
                            "--nodes",
                            "--topology",
                            "--select",
                            "--chain",
                            "--frames",
                            "--radius",
                            "--audit",
                            "--dump",
                            "--log",
                            "--out",
                            "--json",
                            "--quiet",
                            "--help",
                            "-h",
                            "--",
                            "-",
                            "++",
                            "",
                            "=",
                            "--=",
                            "---",
                            "--quiet=",
                            "power",
                            "wrapped",
                            "sorted",
                            "contacts",
                            "linear",
                            "hermite",
                            "filtered",
                            "exact",
                            "backbone",
                            "ca",
                            "all",
                            "none",
                            "frames",
                            "events",
                            "auto",
                            "element",
                            "element:fit",
                            "file:",
                            "file:r.txt",
                            "0:200",
                            "::2",
                            "5:1:1",
                            "0",
                            "-3",
                            "1e400",
                            "nan",
                            "a.pdb",
                            "b.dcd",
                            "[a,b]",
                            "[",
                            "{}",
                            "%%",
                            "'x",
                            "\"",
                            "a b",
                            "\n",
                            "\xff\xfe",
                            "--kernel=",
                            "--kernel=exact",
                            "--json=-",
                            "--radius=1",
                            "-vvv",
                            "-1",
                            "/opt",
                            "18446744073709551616:",
                            "--config",
                            "--groups"};

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

TEST(RunOptionsFuzz, OnlyOptionsHelpOrOneRefusalComeOut) {
  std::mt19937 random(20040614);
  std::size_t accepted = 0, refused = 0, helped = 0;
  for (int round = 0; round < test::rounds(6000); ++round) {
    Arguments arguments(random() % 7);
    for (std::string& word : arguments) word = random_word(random);
    try {
      const RunOptions options = parse_run_options(arguments);
      EXPECT_FALSE(options.inputs.empty());
      ++accepted;
    } catch (const HelpRequest& help) {
      EXPECT_FALSE(help.text.empty());
      ++helped;
    } catch (const InputError& error) {
      EXPECT_FALSE(one_line(error.what()).empty());
      ++refused;
    }
  }
  EXPECT_GT(accepted, test::rounds(100U));
  EXPECT_GT(refused, test::rounds(1000U));
  EXPECT_GT(helped, test::rounds(100U));
}

}  // namespace
}  // namespace kds::parse_run_options_fuzz_test
