#include "experiments/program/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "experiments/figures/paper_figures.h"
#include "experiments/output/page/table.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/option.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr CommandSpec kFiguresCommand{
    "kds figures",
    "Draws figures of Agarwal et al. (2004) that show hierarchies, each as FIGURE.svg in --out.\n\n"
    "  2  wrapped and layered hierarchy of one necklace in the plane\n"
    "  3  two conformations of a necklace in the plane, found by search, between which only the basis of "
    "the root changes\n"
    "  5  the points of Lemma 2.5 and their layered hierarchy",
    "[FIGURE]...",
    "2, 3 or 5 (default: all)",
    "kds figures --out figures\n"
    "kds figures 3 --seed 7 --out figures",
};

struct FiguresAsked : Destinations {
  std::vector<PaperFigure> figures;
  StablePairSearch search;
};

const OptionList<FiguresAsked>& figures_options() {
  using O = FiguresAsked;
  using S = StablePairSearch;
  static const auto list =
      OptionList<O>()
          .with(&O::search,
                {{whole_option({"--beads", "N", "beads of the necklace of figure 3 (default: 32)"}, &S::beads,
                               8, 256),
                  whole_option({"--candidates", "N",
                                "candidates for figure 3, of which the most deformed one is drawn (default: "
                                "2000)"},
                               &S::candidates, 1, 10'000'000),
                  whole_option({"--seed", "N", "seed of the candidates (default: 1)"}, &S::seed, 0,
                               UINT64_MAX)}})
          .with(data_options("write figure-2.svg, figure-3.svg, figure-5.svg, figures.json and "
                             "figures.csv to DIR (default: none)"));
  return list;
}

FiguresAsked parse_figures(const Arguments& arguments) {
  FiguresAsked asked;
  const ParsedArguments parsed = read_arguments(kFiguresCommand, figures_options(), arguments, asked);
  for (const std::string& name : parsed.operands()) {
    const auto figure = choice_of<PaperFigure>("FIGURE", name, figure_names);
    if (std::ranges::find(asked.figures, figure) != asked.figures.end())
      throw InputError(fmt::format("FIGURE: {} is listed twice", name));
    asked.figures.push_back(figure);
  }
  if (asked.figures.empty())
    asked.figures = {PaperFigure::hierarchies, PaperFigure::stability, PaperFigure::tightness};
  std::ranges::sort(asked.figures);
  const bool searches = std::ranges::find(asked.figures, PaperFigure::stability) != asked.figures.end();
  for (const char* option : {"--beads", "--candidates", "--seed"})
    if (!searches && parsed.has(option))
      throw InputError(fmt::format("{} applies only to figure 3, which is found by search", option));
  return asked;
}

Table<DrawnPanel> panel_columns() {
  using Row = DrawnPanel;
  return std::vector<Column<Row>>{
      {"figure", "figure", [](const Row& r) { return Field(name_of(r.figure)); }},
      {"panel", "panel", [](const Row& r) { return Field(r.panel); }},
      {"beads", "beads", [](const Row& r) { return Field(r.beads); }},
      {"root_radius", "radius of the root", [](const Row& r) { return Field(r.root_radius); }, shortly},
      {"sticking_out", "circles outside their parent's", [](const Row& r) { return Field(r.sticking_out); }},
      {"note", "note", [](const Row& r) { return Field(r.note); }}};
}

std::string file_of(PaperFigure figure) { return fmt::format("figure-{}.svg", name_of(figure)); }

}  // namespace

int figures_command(const Arguments& arguments) {
  const FiguresAsked asked = parse_figures(arguments);
  TableCommand command("figures", arguments, asked, "figure");
  std::vector<std::string> names{"figures.json", "figures.csv"};
  for (const PaperFigure figure : asked.figures) names.push_back(file_of(figure));
  command.check_destinations({}, names);

  std::vector<DrawnPanel> panels;
  TableCommand::Csvs files;
  for (std::size_t k = 0; k < asked.figures.size(); ++k) {
    DrawnFigure drawn = draw(asked.figures[k], asked.search);
    panels.insert(panels.end(), drawn.panels.begin(), drawn.panels.end());
    files.emplace_back(file_of(asked.figures[k]), std::move(drawn.svg));
    command.progress()(k + 1, asked.figures.size());
  }
  command.bar().erase();
  files.emplace_back("figures.csv", panel_columns().csv(panels));

  std::vector<std::string_view> figures;
  for (const PaperFigure figure : asked.figures) figures.push_back(name_of(figure));
  Json json;
  json["settings"] = figures_options().settings_json(asked, {{"figures", figures}});
  json["rows"] = panel_columns().json(panels);
  command.deliver(std::move(json), files, panel_columns().text(panels));
  return 0;
}

}  // namespace kds
