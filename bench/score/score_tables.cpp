#include "bench/score/score_tables.hpp"

#include <string>
#include <string_view>

#include "scenarios/results/list_columns.hpp"

namespace dualdamp::bench {

namespace {

using scenarios::Json;
using scenarios::Table;

template <typename Item>
using Columns = scenarios::ListColumns<Item, Grid>;

/// The value of a member of the item, whatever the grid.
template <typename Item, typename Base, typename Value>
auto number(Value Base::* member) {
  return [member](const Item& item, const Grid&) { return static_cast<double>(item.*member); };
}

template <typename Item>
std::string entrant_of(const Item& item, const Grid& grid) {
  return grid.question().entrant(item.entrant);
}

/// The columns that all tables of scores end with: each metric and its standard error.
template <typename Item>
Columns<Item> with_metrics(Columns<Item> columns) {
  for (std::size_t i = 0; i < metric_count; ++i) {
    const MetricText& metric = metric_list.at(i);
    const std::string name(metric.name);
    columns.push_back({name, "1", std::string(metric.meaning),
                       [i](const Item& item, const Grid&) { return item.value.values.at(i); }});
    columns.push_back({name + "_se", "1", "its standard error",
                       [i](const Item& item, const Grid&) { return item.se.values.at(i); }});
  }
  return columns;
}

Columns<Rank> ranking_columns() {
  return with_metrics<Rank>(
      {{"method", "", "a method or an entry, best first", entrant_of<Rank>},
       {"rank_from", "1", "1 + number of those that are better by more than two standard errors",
        number<Rank>(&Rank::from)},
       {"rank_to", "1", "number of those that are not worse by more than two standard errors",
        number<Rank>(&Rank::to)},
       {"interval_score", "1", "mean of the interval scores of zeta and F0, by which the ranking is made",
        number<Rank>(&Rank::interval_score)},
       {"interval_score_se", "1", "its standard error", number<Rank>(&Rank::interval_score_se)}});
}

Columns<FamilyScore> family_columns() {
  return with_metrics<FamilyScore>(
      {{"family", "", "family of departures, or none",
        [](const FamilyScore& s, const Grid&) { return std::string(name_of(s.family)); }},
       {"method", "", "a method or an entry", entrant_of<FamilyScore>}});
}

Columns<CaseDeparture> departure_columns() {
  return {{"departure", "", "name of the departure", [](const CaseDeparture& d, const Grid&) { return d.name(); }},
          {"family", "", "what it changes, such as friction or the drive",
           [](const CaseDeparture& d, const Grid&) { return std::string(name_of(d.family())); }},
          {"severity", "", "what its severity means",
           [](const CaseDeparture& d, const Grid&) { return d.meaning_of_severity(); }}};
}

Columns<Difference> difference_columns() {
  return {{"better", "", "the better of two",
           [](const Difference& d, const Grid& grid) { return grid.question().entrant(d.better); }},
          {"worse", "", "the other",
           [](const Difference& d, const Grid& grid) { return grid.question().entrant(d.worse); }},
          {"difference", "1", "difference of their interval scores", number<Difference>(&Difference::value)},
          {"difference_se", "1", "its standard error", number<Difference>(&Difference::se)},
          {"significant", "", "whether it exceeds two standard errors",
           number<Difference>(&Difference::is_significant), scenarios::CellKind::truth}};
}

Columns<ConsequenceScore> by_consequence_columns() {
  using Score = ConsequenceScore;
  return with_metrics<Score>(
      {{"of", "", "distance or harm", [](const Score& s, const Grid&) { return s.axis; }},
       {"from", "1", "smallest distance or harm of these cases", number<Score>(&Score::from)},
       {"to", "1", "their distance or harm is below this; null: no limit", number<Score>(&Score::to)},
       {"method", "", "a method or an entry", entrant_of<Score>},
       {"departures", "1", "departures that have such cases", number<Score>(&Score::departures)},
       {"cases", "1", "number of these cases", number<Score>(&Score::cases)}});
}

Columns<CellScore> cell_columns() {
  const auto place = [](const CellScore& score, const Grid& grid) { return grid.first_of_cell(score.cell); };
  const auto motion = [place](const CellScore& score, const Grid& grid) {
    return grid.motion(place(score, grid).motion);
  };
  return with_metrics<CellScore>(
      {{"family", "", "family of the departure, or none",
        [=](const CellScore& s, const Grid& g) { return std::string(name_of(motion(s, g).departure.family())); }},
       {"law", "", "departure, or coulomb_viscous",
        [=](const CellScore& s, const Grid& g) { return motion(s, g).departure.name(); }},
       {"severity", "1", "severity of the departure",
        [=](const CellScore& s, const Grid& g) { return motion(s, g).severity; }},
       {"range", "", "range of excitation",
        [=](const CellScore& s, const Grid& g) { return g.question().ranges[motion(s, g).range].name; }},
       {"sensors", "", "sensors",
        [=](const CellScore& s, const Grid& g) { return g.question().sensors[place(s, g).sensors].name; }},
       {"method", "", "a method or an entry", entrant_of<CellScore>},
       {"cases", "1", "rigs times seeds", number<CellScore>(&CellScore::cases)},
       {"estimates", "1", "cases with an estimate", number<CellScore>(&CellScore::estimates)},
       {"distance", "1", "mean distance over the rigs, in units of the sensors' noise",
        number<CellScore>(&CellScore::distance)},
       {"harm", "1", "mean harm over the rigs", number<CellScore>(&CellScore::harm)},
       {"zeta_bias", "1", "mean error of zeta, relative", number<CellScore>(&CellScore::zeta_bias)},
       {"F0_bias", "1", "mean error of F0, relative", number<CellScore>(&CellScore::F0_bias)},
       {"zeta_error", "1", "median of the absolute error of zeta, relative",
        number<CellScore>(&CellScore::zeta_error)},
       {"F0_error", "1", "median of the absolute error of F0, relative", number<CellScore>(&CellScore::F0_error)}});
}

/// A consequence with its place in the list, which says to which motion and sensors it belongs.
struct PlacedConsequence {
  std::size_t row = 0;
  const CaseConsequence* found = nullptr;

  [[nodiscard]] Grid::Motion motion(const Grid& grid) const {
    return grid.motion(row / grid.question().sensors.size());
  }
  [[nodiscard]] const TrueRig& rig(const Grid& grid) const { return grid.question().rigs[motion(grid).rig]; }
};

Columns<PlacedConsequence> consequence_columns() {
  using Placed = PlacedConsequence;
  const auto found = [](double CaseConsequence::* member) {
    return [member](const Placed& c, const Grid&) { return c.found->*member; };
  };
  return {{"law", "", "departure, or coulomb_viscous",
           [](const Placed& c, const Grid& g) { return c.motion(g).departure.name(); }},
          {"severity", "1", "severity of the departure",
           [](const Placed& c, const Grid& g) { return c.motion(g).severity; }},
          {"rig", "1", "number of the rig, from 0",
           [](const Placed& c, const Grid& g) { return static_cast<double>(c.motion(g).rig); }},
          {"range", "", "range of excitation",
           [](const Placed& c, const Grid& g) { return g.question().ranges[c.motion(g).range].name; }},
          {"sensors", "", "sensors",
           [](const Placed& c, const Grid& g) {
             return g.question().sensors[c.row % g.question().sensors.size()].name;
           }},
          {"zeta", "1", "damping ratio of the rig",
           [](const Placed& c, const Grid& g) { return c.rig(g).parameters().zeta; }},
          {"F0", "N", "friction force of the rig",
           [](const Placed& c, const Grid& g) { return c.rig(g).parameters().F0; }},
          {"distance", "1",
           "distance of the readings from those of the nearest Coulomb and viscous motion, in units of noise",
           found(&CaseConsequence::distance)},
          {"harm", "1", "largest relative error of zeta and F0 of that motion", found(&CaseConsequence::harm)},
          {"harm_zeta", "1", "relative error of zeta of that motion", found(&CaseConsequence::harm_zeta)},
          {"harm_F0", "1", "relative error of F0 of that motion", found(&CaseConsequence::harm_F0)},
          {"attainable_power", "1", "power of the best test that knows the departure",
           found(&CaseConsequence::attainable_power)},
          {"cramer_rao_zeta", "1", "smallest relative standard deviation of zeta if the law is known",
           found(&CaseConsequence::cramer_rao_zeta)},
          {"cramer_rao_F0", "1", "the same of F0", found(&CaseConsequence::cramer_rao_F0)}};
}

std::vector<PlacedConsequence> placed(const std::vector<CaseConsequence>& consequences) {
  std::vector<PlacedConsequence> list;
  for (const CaseConsequence& found : consequences) list.push_back({list.size(), &found});
  return list;
}

/// The columns of the ranking that fit a terminal.
Table short_ranking(const Table& ranking) {
  Table table{.name = ranking.name, .is_file = false};
  for (const std::string_view name :
       {std::string_view("method"), std::string_view("rank_from"), std::string_view("rank_to"),
        std::string_view("interval_score"), std::string_view("interval_score_se"), name_of(Metric::coverage_zeta),
        name_of(Metric::coverage_F0), name_of(Metric::power), name_of(Metric::attainable_power),
        name_of(Metric::false_alarm), name_of(Metric::prediction_error)})
    table.columns.push_back(*ranking.find(name));
  return table;
}

Json summary(const MarkedCases& cases, const Grid& grid) {
  const StressTest& question = grid.question();
  Json json;
  json["cases"] = {{"all", grid.cases()},
                   {"failed", cases.failed_cases},
                   {"motions", grid.motions()},
                   {"rigs", question.rigs.size()},
                   {"estimates", grid.cases() * question.entrants()}};
  for (const char* key :
       {"ranking", "families", "departures", "differences", "by_consequence", "scores", "consequences"})
    json[key] = nullptr;
  return json;
}

}  // namespace

scenarios::Answer answer_of(const MarkedCases& cases, const Grid& grid) {
  using scenarios::list_table;
  const Scores scores = score(cases, grid);
  const Table ranking = list_table("ranking", ranking_columns(), scores.ranking, grid);
  scenarios::Answer answer;
  answer.result = summary(cases, grid);
  answer.tables = {short_ranking(ranking),
                   ranking,
                   list_table("families", family_columns(), scores.families, grid),
                   list_table("departures", departure_columns(), grid.question().departures, grid),
                   list_table("differences", difference_columns(), scores.differences, grid),
                   list_table("by_consequence", by_consequence_columns(), scores.by_consequence, grid),
                   list_table("scores", cell_columns(), scores.cells, grid),
                   list_table("consequences", consequence_columns(), placed(cases.consequences), grid)};
  if (cases.failed_cases > 0) answer.status = core::ExitStatus::some_cases_failed;
  return answer;
}

std::vector<scenarios::ResultField> score_fields() {
  using scenarios::add_list_fields;
  std::vector<scenarios::ResultField> fields = {{"cases.all", "1", "cases of the grid"},
                                                {"cases.failed", "1", "cases without an estimate by any method"},
                                                {"cases.motions", "1", "motions computed for them"},
                                                {"cases.rigs", "1", "rigs"},
                                                {"cases.estimates", "1", "cases times methods and entries"}};
  add_list_fields("ranking", ranking_columns(), fields);
  add_list_fields("families", family_columns(), fields);
  add_list_fields("departures", departure_columns(), fields);
  add_list_fields("differences", difference_columns(), fields);
  add_list_fields("by_consequence", by_consequence_columns(), fields);
  add_list_fields("scores", cell_columns(), fields);
  add_list_fields("consequences", consequence_columns(), fields);
  return fields;
}

}  // namespace dualdamp::bench
