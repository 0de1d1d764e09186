// The measurements of `kds trade`, compared with results computed in another way, and the command itself.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "experiments/output/text.h"
#include "experiments/run/run_options.h"
#include "experiments/trade/measure_trade.h"
#include "experiments/trade/trade_report.h"
#include "motions/readers/read_trajectory.h"
#include "tests/experiments/report_data.h"
#include "tests/experiments/run_json.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/support/rounds.h"

namespace kds::trade_test {
namespace {

using namespace test;
using testing::HasSubstr;

FinestData villin(std::size_t frames, double radius) {
  ReadOptions options;
  options.frames = {0, frames, 1};
  options.topology = data_file("trajectories/villin_hp36_300K.pdb");
  Trajectory trajectory = read_trajectory(data_file("trajectories/villin_hp36_300K.dcd"), options);
  std::vector<double> radii(trajectory.bead_count(), radius);
  std::vector<Trajectory> necklaces;
  necklaces.push_back(std::move(trajectory));
  return {std::move(necklaces), std::move(radii), std::to_string(radius)};
}

std::vector<TradeRow> measured(const FinestData& finest, std::vector<Want> wants) {
  TradeTask task;
  task.wants = std::move(wants);
  task.rounds = 1;
  task.sampling.times = 20;
  task.apart = 5;
  task.exact_kernel = false;
  return measure_trade(
      finest, task, [](auto, auto) {}, [](auto&) {});
}

const TradeRow& row_of(const std::vector<TradeRow>& rows, std::string_view words) {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const TradeRow& row) { return words_of(row.setting) == words; });
  if (found == rows.end()) throw std::logic_error("no row " + std::string(words));
  return *found;
}

TEST(Trade, TheExactRunErrsNowhere) {
  const std::vector<TradeRow> rows =
      measured(villin(rounds(13U, 9U), 2.0), {Want::contacts, Want::cages, Want::diagram, Want::events});
  std::size_t exact = 0;
  for (const TradeRow& row : rows) {
    SCOPED_TRACE(words_of(row.setting));
    EXPECT_GT(row.cost.seconds, 0);
#ifndef KDS_SANITIZED  // the sanitizers use memory of their own
    EXPECT_GT(row.cost.memory, 1000U);
#endif
    if (!row.is_exact) continue;
    ++exact;
    EXPECT_EQ(row.cost.ratio, 1.0);
    EXPECT_GT(row.cost.events, 0U);
    for (const auto& [name, value] : by_name(row.errors)) {
      EXPECT_NEAR(value.value_or(0), 0, name == "beads_outside" ? 0 : 1e-9) << name;
    }
  }
  EXPECT_EQ(exact, 6U);
}

TEST(Trade, TheExactKernelHasTheSameEventsAtAnotherPrice) {
  TradeTask task;
  task.wants = {Want::diagram, Want::events};
  task.rounds = 1;
  task.sampling.times = 2;
  const std::vector<TradeRow> rows = measure_trade(
      villin(3, 1.0), task, [](auto, auto) {}, [](auto&) {});
  for (const std::string structure : {"wrapped", "power", "contacts"}) {
    const TradeRow& exact = row_of(rows, structure + " --kernel exact");
    EXPECT_EQ(exact.cost.events, row_of(rows, structure).cost.events);
    EXPECT_FALSE(exact.is_exact);
    for (const auto& [name, value] : by_name(exact.errors)) EXPECT_NEAR(value.value_or(0), 0, 1e-9) << name;
  }
}

TEST(Trade, ContainmentIsKeptWhereItIsPromised) {
  const std::vector<TradeRow> rows = measured(villin(17, 1.0), {Want::cages});
  for (const char* words :
       {"wrapped --between chord", "wrapped --between chord --tightness 0.01", "layered"}) {
    const TradeErrors& errors = row_of(rows, words).errors;
    EXPECT_EQ(errors.beads_outside, 0.0) << words;
    EXPECT_EQ(errors.displacement, 0.0) << words;
    EXPECT_GT(errors.radius_max.value(), 1e-6) << words;
    EXPECT_FALSE(errors.events_missed) << words;
  }
  EXPECT_LE(row_of(rows, "wrapped --between chord --tightness 0.003").errors.radius_max.value(),
            0.003 + 1e-9);
  EXPECT_GT(row_of(rows, "wrapped --frames ::4").errors.beads_outside.value(), 0);
  for (const TradeRow& row : rows) {
    for (const TradeRow& other : rows) {
      if (!row.on_front) continue;
      EXPECT_FALSE(other.cost.ratio < row.cost.ratio &&
                   other.errors.radius_mean.value() < row.errors.radius_mean.value() &&
                   other.errors.beads_outside.value() < row.errors.beads_outside.value())
          << words_of(other.setting) << " is better than " << words_of(row.setting);
    }
  }
}

TEST(Trade, CertifiedRunsMissNothingAndNothingSureIsWrong) {
  const std::vector<TradeRow> rows = measured(villin(17, 2.2), {Want::contacts, Want::cages});
  std::size_t certified = 0;
  bool any_sure = false;
  for (const TradeRow& row : rows) {
    SCOPED_TRACE(words_of(row.setting));
    const TradeErrors& errors = row.errors;
    EXPECT_EQ(errors.sure_wrong.has_value(), row.setting.certify && row.want == Want::contacts);
    if (!row.setting.certify) continue;
    ++certified;
    if (row.want == Want::contacts) {
      EXPECT_EQ(errors.contacts_missed, 0.0);
      EXPECT_EQ(errors.sure_wrong, 0.0);
      EXPECT_GT(errors.contacts_spurious.value(), 0);
      any_sure |= errors.contacts_unsure.value() < 1;
    } else {
      EXPECT_EQ(errors.beads_outside, 0.0);
      EXPECT_GT(errors.radius_mean.value(), 0.001);
    }
  }
  EXPECT_EQ(certified, 7U);
  EXPECT_TRUE(any_sure);
  EXPECT_GT(row_of(rows, "wrapped --frames ::2").errors.beads_outside.value(), 0);
  EXPECT_GT(row_of(rows, "contacts --frames ::2").errors.contacts_missed.value(), 0);
}

/// Returns all that a run of a setting gives, as text.
std::string text_of(const FollowedRun& run) {
  std::string text = fmt::format("end {} tests {}\n", run.history.end, run.tests.value_or(-1));
  for (const auto& [name, error] : by_name(run.errors))
    if (error) text += fmt::format("{} {}\n", name, *error);
  for (const TimedEvent& event : run.history.events)
    text += fmt::format("{} {} {}\n", event.time, event.change.kind,
                        fmt::join(event.change.ids.data(), event.change.ids.data() + event.change.size, ","));
  for (const auto* const contacts : {&run.history.contacts, &run.history.sure})
    for (const ContactTime& contact : *contacts)
      text += fmt::format("{}-{} {} {}\n", contact.pair.first, contact.pair.second, contact.from, contact.to);
  return text;
}

// The runs stop within steps, on the threads of their parts.
TEST(Trade, RunsAreTheSameOnSeveralThreads) {
  const FinestData finest = villin(760, 2.0);
  const Scene truest = finest.scene();
  const std::unique_ptr<Truth> truth = make_truth(truest, {truest.necklaces(), true, 5, true, {}});
  SamplingOfTimes sampling;
  sampling.times = 12;
  for (const auto& [structure, stride] : {std::pair("wrapped", 1U), std::pair("power", 1U),
                                          std::pair("contacts", 1U), std::pair("contacts", 2U)}) {
    SCOPED_TRACE(structure);
    TradeSetting setting;
    setting.structure = structure;
    setting.stride = stride;
    setting.certify = stride > 1;
    setting.settings.apart = 5;
    const auto on = [&](std::size_t threads) {
      return follow_run(finest, setting, *truth, sampling, 8.0, threads);
    };
    const FollowedRun one = on(1), two = on(2);
    EXPECT_EQ(one.threads, 1U);
    EXPECT_EQ(two.threads, 2U);
    EXPECT_GT(one.history.events.size(), 10U);
    EXPECT_EQ(text_of(two), text_of(one));
  }
}

TEST(Trade, CalphaAloneIsAnotherModel) {
  const FinestData finest = villin(13, 2.0);
  const std::vector<TradeRow> rows = measured(finest, {Want::contacts, Want::cages, Want::diagram});
  const std::string by_hand = fmt::format(" --radius {}", finest.calpha()->covering_radius);
  const TradeErrors& contacts = row_of(rows, "contacts --select ca --apart 2").errors;
  EXPECT_EQ(contacts.contacts_missed, 1.0);  // CA atoms are 3.8 apart, and closer than 4 only along the chain
  EXPECT_FALSE(contacts.events_missed);
  EXPECT_EQ(contacts.displacement, 0.0);
  const TradeErrors& covering = row_of(rows, "contacts --select ca" + by_hand + " --apart 2").errors;
  EXPECT_EQ(covering.contacts_missed, 0.0);
  EXPECT_GT(covering.contacts_spurious.value(), 0);
  const TradeRow& diagram = row_of(rows, "power --select ca");
  EXPECT_FALSE(diagram.errors.cells_wrong);  // C-alpha cells are not cells of all beads
  EXPECT_FALSE(diagram.on_front);
  EXPECT_LT(diagram.cost.certificates, row_of(rows, "power").cost.certificates / 2);
  const TradeErrors& cages = row_of(rows, "wrapped --select ca").errors;
  EXPECT_GT(cages.beads_outside.value(), 0);
  EXPECT_GT(cages.radius_max.value(), 0.001);
  EXPECT_EQ(row_of(rows, "wrapped --select ca" + by_hand).errors.beads_outside, 0.0);
}

TEST(Trade, SettingsAreOptionsOfARun) {
  TradeInput input;
  input.frames = 100;
  input.beads = 60;
  input.residues = 20;
  input.largest_residue = 3;
  input.residue_radius = 2.5;
  input.has_element_radii = input.exact_kernel = true;
  input.range = {1, 91, 3};
  std::size_t strides = 0;
  for (const Want want : {Want::contacts, Want::cages, Want::diagram, Want::events, Want::scenes})
    for (const TradeGroup& group : groups_for(want, input, 5))
      for (const TradeSetting& setting : group.settings) {
        if (setting.projected) continue;  // no option expresses this property
        Arguments arguments{"chain.pdb", "--structures"};
        for (const std::string& word : split(words_of(setting), ' ')) arguments.push_back(word);
        RunOptions options;
        ASSERT_NO_THROW(options = parse_run_options(arguments)) << words_of(setting);
        if (setting.stride == 1) continue;
        ++strides;
        EXPECT_EQ(options.reading.frames.first, 1U);
        EXPECT_EQ(options.reading.frames.last, 91U);
        EXPECT_EQ(options.reading.frames.stride, 3 * setting.stride);
      }
  EXPECT_GT(strides, 10U);
}

TEST(Trade, CalphaAsksAboutAllResiduesOfBeadsSoFarApart) {
  const auto apart_of = [](BeadId largest_residue, BeadId apart) {
    TradeInput input;
    input.frames = 2;
    input.beads = 60;
    input.residues = 20;  // 3 beads per residue on average
    input.largest_residue = largest_residue;
    const std::vector<TradeGroup> groups = groups_for(Want::contacts, input, apart);
    const auto found = std::ranges::find_if(groups.front().settings, &TradeSetting::calpha);
    if (found == groups.front().settings.end()) throw std::logic_error("no setting of CA alone");
    return found->settings.apart;
  };
  EXPECT_EQ(apart_of(3, 20), 6U);  // beads 0 and 20 belong to residues 0 and 6
  EXPECT_EQ(apart_of(3, 21), 7U);
  EXPECT_EQ(apart_of(5, 20), 4U);  // the largest residue counts, not the mean
  EXPECT_EQ(apart_of(3, 5), 2U);   // adjacent residues are never compared
}

TEST(Trade, CalphaErrsByAnUnknownShareWithoutTrueContacts) {
  const FinestData finest = villin(3, 2.0);
  EXPECT_EQ(finest.input().largest_residue, 3U);
  TradeSetting setting;
  setting.structure = "contacts";
  setting.calpha = true;
  TradeRow row{Want::contacts, setting, {}, {}};
  const auto compare = [&](const RunHistory& exact) {
    FollowedRun run{{2, {}, {{{0, 5}, 0, 1}}, {}}, {}, {}};
    compare_histories(exact, run, finest, setting);
    row.errors = run.errors;
  };
  compare({2, {}, {{{0, 4}, 0, 1}}, {}});  // a contact of adjacent residues
  EXPECT_FALSE(row.errors.contacts_missed);
  EXPECT_FALSE(row.errors.contacts_spurious);
  EXPECT_TRUE(main_errors(row).empty());
  compare({2, {}, {{{0, 4}, 0, 1}, {{0, 10}, 0, 1}}, {}});  // the second is a contact of residues 0 and 3
  EXPECT_EQ(row.errors.contacts_missed, 1.0);
  EXPECT_EQ(row.errors.contacts_spurious, 1.0);
}

// The exact run of contacts has the events of kds run with the same groups.
TEST(Trade, GroupsChoosePairsOfContacts) {
  const std::string input = " VILLIN --frames :6 --radius 1.9 --apart 4", groups = " --groups //A/-60 45-/N",
                    contacts = " --want contacts --without-exact --rounds 1 --times 3";
  const auto all = run_json("trade" + input + contacts),
             trade = run_json("trade" + input + contacts + groups),
             run = run_json("run" + input + " --structures contacts" + groups);
  const auto& exact = trade["rows"][0];
  EXPECT_GT(exact["cost"]["events"], 0);
  EXPECT_EQ(exact["cost"]["events"], run["structures"]["contacts"]["events"]["total"]);
  EXPECT_LT(exact["cost"]["events"], all["rows"][0]["cost"]["events"]);
  EXPECT_EQ(exact["error"]["contacts_missed"], 0);
  EXPECT_EQ(exact["error"]["closest_distance"], 0);
  EXPECT_EQ(trade["settings"]["groups"], "//A/-60 45-/N");
  EXPECT_NE(all["rows"].dump().find("\"ca\""), std::string::npos);
  EXPECT_EQ(trade["rows"].dump().find("\"ca\""), std::string::npos);
}

TEST(Trade, LeavesOutWhatCannotBeCertifiedAndSaysSo) {
  Trajectory chain;
  Eigen::Matrix3Xd frame = Eigen::Matrix3Xd::Random(3, 6) * 1e171;
  for (int k = 0; k < 5; ++k) {
    chain.frames.push_back(frame);
    frame.col(k) *= -1;
  }
  const FinestData finest({chain}, std::vector<double>(6, 1e153), "1e153");
  TradeTask task;
  task.wants = {Want::contacts};
  task.rounds = 1;
  task.sampling.times = 2;
  std::vector<std::string> warnings;
  const std::vector<TradeRow> rows = measure_trade(
      finest, task, [](auto, auto) {}, [&](const std::string& warning) { warnings.push_back(warning); });
  ASSERT_FALSE(warnings.empty());
  EXPECT_THAT(warnings.front(), HasSubstr("`contacts --frames ::2 --certify` is left out: bead"));
  EXPECT_NO_THROW(static_cast<void>(row_of(rows, "contacts --frames ::2")));
  for (const TradeRow& row : rows) EXPECT_NE(words_of(row.setting), "contacts --frames ::2 --certify");
}

TEST(Trade, ScenesCostByWhatIsAskedFor) {
  ReadOptions options;
  options.frames = {0, 9, 1};
  options.topology = data_file("trajectories/villin_hp36_300K.pdb");
  std::vector<Trajectory> necklaces(2,
                                    read_trajectory(data_file("trajectories/villin_hp36_300K.dcd"), options));
  for (Eigen::Matrix3Xd& frame : necklaces[1].frames) frame.row(0).array() += 12;
  std::vector<double> radii(2 * necklaces[0].bead_count(), 2.0);
  const std::vector<TradeRow> rows =
      measured(FinestData(std::move(necklaces), std::move(radii), "2"), {Want::scenes});
  const TradeCost& between = row_of(rows, "contacts --apart 216").cost;
  const TradeCost& contacts = row_of(rows, "contacts").cost;
  const TradeCost& with_cages = row_of(rows, "contacts,wrapped").cost;
  const TradeCost& all = row_of(rows, "contacts,wrapped,power").cost;
  const TradeCost& power = row_of(rows, "power").cost;
  const TradeCost& wrapped = row_of(rows, "wrapped").cost;
  EXPECT_LT(between.certificates, contacts.certificates);
  EXPECT_LE(between.events, contacts.events);
  EXPECT_EQ(with_cages.certificates, contacts.certificates + wrapped.certificates);
  EXPECT_EQ(with_cages.events, contacts.events + wrapped.events);
  EXPECT_EQ(all.certificates, with_cages.certificates + power.certificates);
  EXPECT_LT(row_of(rows, "wrapped --levels 0:4").cost.certificates, wrapped.certificates);
  EXPECT_LT(row_of(rows, "wrapped --nodes 0:109").cost.certificates, wrapped.certificates);
  EXPECT_LT(row_of(rows, "contacts,wrapped,power, projected").cost.certificates, all.certificates);
  EXPECT_NO_THROW(static_cast<void>(row_of(rows, "contacts,wrapped,power --radius element")));
  EXPECT_NO_THROW(static_cast<void>(row_of(rows, "contacts,wrapped,power --select ca --apart 2")));
  for (const TradeRow& row : rows) {
    EXPECT_FALSE(row.on_front);
    for (const auto& [name, value] : by_name(row.errors)) EXPECT_FALSE(value) << name;
  }
  EXPECT_THAT(recommendation(rows), HasSubstr("costs least"));
}

TEST(Trade, AStrideIsWrongByWhatItLeavesOut) {
  const FinestData finest = villin(9, 1.0);
  const Scene scene = finest.scene();
  // The maximum over the skipped frames is computed by hand. Random times in between may add a little, and
  // samples at frames alone miss some of it.
  double farthest = 0;
  for (std::size_t k = 0; k <= 8; ++k) {
    const double u = static_cast<double>(k) / 8;
    const Eigen::Matrix3Xd between = (1 - u) * scene.centers(0) + u * scene.centers(8);
    farthest = std::max(farthest, (between - scene.centers(k)).colwise().norm().maxCoeff());
  }
  TradeTask task;
  task.wants = {Want::diagram};
  task.rounds = 1;
  task.sampling.times = rounds(500U);
  const std::vector<TradeRow> rows = measure_trade(
      finest, task, [](auto, auto) {}, [](auto&) {});
  const TradeErrors& errors = row_of(rows, "power --frames ::8").errors;
  EXPECT_NEAR(errors.displacement.value(), farthest, 1e-9);
  EXPECT_GT(errors.cells_wrong.value(), 0.01);
  EXPECT_GT(errors.events_missed.value(), 0.1);
  EXPECT_LT(row_of(rows, "power --frames ::2").errors.cells_wrong.value(), errors.cells_wrong.value());
}

TEST(Trade, RecommendsWhatHasSmallErrors) {
  TradeRow exact{Want::cages, {"wrapped"}, {}, {}, true};
  exact.errors.radius_mean = exact.errors.radius_max = exact.errors.beads_outside = 0;
  TradeRow chord = exact, stride = exact;
  chord.is_exact = stride.is_exact = false;
  chord.setting.settings.between = Between::chord;
  exact.cost.events = 9;
  chord.cost.ratio = 0.2;
  chord.errors.radius_mean = 0.0002;
  stride.setting.stride = 8;
  stride.cost.ratio = 0.1;
  stride.errors.beads_outside = 3;
  EXPECT_THAT(
      recommendation(std::vector{exact, stride, chord}),
      testing::AllOf(HasSubstr("For cages, `wrapped --between chord` is 5 times as fast"),
                     HasSubstr("0.02% from the smallest on average"), HasSubstr("no bead is outside")));
  EXPECT_THAT(recommendation(std::vector{exact, stride}), HasSubstr("stay with the exact run"));
  EXPECT_THAT(recommendation(std::vector{exact}), HasSubstr("nothing is quicker than the exact run"));
  chord.cost.ratio = 0.005;
  EXPECT_THAT(recommendation(std::vector{exact, chord}), HasSubstr("is 200 times as fast"));
}

TEST(TradeCommand, WritesRowsAndAPage) {
  const ScratchDirectory directory;
  const auto json = run_json("trade VILLIN --frames 0:9 --rounds 1 --times 5 --want cages --out OUT/result",
                             directory.path());
  EXPECT_FALSE(json.at("recommendation").get<std::string>().empty());
  ASSERT_FALSE(json.at("rows").empty());
  for (const auto& row : json.at("rows")) {
    EXPECT_EQ(row.at("want"), "cages");
    EXPECT_TRUE(row.at("setting").contains("structures"));
    EXPECT_GT(row.at("cost").at("seconds").get<double>(), 0);
    EXPECT_TRUE(row.at("cost").contains("tests"));
    EXPECT_TRUE(row.at("error").at("cells_wrong").is_null());
    EXPECT_TRUE(row.at("error").at("radius_mean").is_number());
  }
  EXPECT_THAT(test::content_of(directory.path() / "result" / "trade.csv"), HasSubstr(",true\n"));  // pareto
  EXPECT_EQ(test::ReportData(directory.path() / "result" / "report.html").result, json);
}

TEST(Recommendation, SaysHowToGetContacts) {
  const TradeRow exact{Want::contacts, {.structure = "contacts"}, {}, {}, true};
  EXPECT_THAT(recommendation(std::vector{exact}),
              testing::AllOf(HasSubstr("--radius"), HasSubstr("--apart")));
}

}  // namespace
}  // namespace kds::trade_test
