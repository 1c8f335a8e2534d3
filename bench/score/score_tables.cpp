#include "bench/score/score_tables.hpp"

#include <string>

namespace dualdamp::bench {

namespace {

using scenarios::column;
using scenarios::Json;
using scenarios::Table;
using scenarios::text_column;

/// The columns that all tables of scores have: each metric and its standard error.
template <typename Item>
void add_metrics(Table& table, const std::vector<Item>& list) {
  for (std::size_t i = 0; i < metric_count; ++i) {
    const std::string name(metric_list.at(i).name);
    table.columns.push_back(column(name, "", list, [i](const Item& item) { return item.value.values.at(i); }));
    table.columns.push_back(column(name + "_se", "", list, [i](const Item& item) { return item.se.values.at(i); }));
  }
}

Table cell_table(const Scores& scores, const Grid& grid) {
  const StressTest& question = grid.question();
  const std::vector<CellScore>& list = scores.cells;
  const auto place = [&](const CellScore& score) { return grid.first_of_cell(score.cell); };
  const auto motion = [&](const CellScore& score) { return grid.motion(place(score).motion); };
  const auto family = [&](const CellScore& score) { return name_of(motion(score).departure.family()); };
  Table table{
      "scores",
      {text_column("family", list, family),
       text_column("law", list, [&](const CellScore& s) { return motion(s).departure.name(); }),
       column("severity", "", list, [&](const CellScore& s) { return motion(s).severity; }),
       text_column("range", list, [&](const CellScore& s) { return question.ranges[motion(s).range].name; }),
       text_column("sensors", list, [&](const CellScore& s) { return question.sensors[place(s).sensors].name; }),
       text_column("method", list, [&](const CellScore& s) { return question.entrant(s.entrant); }),
       column("cases", "", list, &CellScore::cases), column("estimates", "", list, &CellScore::estimates),
       column("distance", "", list, &CellScore::distance), column("harm", "", list, &CellScore::harm),
       column("zeta_bias", "", list, &CellScore::zeta_bias), column("F0_bias", "", list, &CellScore::F0_bias),
       column("zeta_error", "", list, &CellScore::zeta_error), column("F0_error", "", list, &CellScore::F0_error)},
      true};
  add_metrics(table, list);
  table.key = "scores";
  return table;
}

Table family_table(const Scores& scores, const Grid& grid) {
  const std::vector<FamilyScore>& list = scores.families;
  Table table{
      "families",
      {text_column("family", list, [](const FamilyScore& s) { return name_of(s.family); }),
       text_column("method", list, [&](const FamilyScore& s) { return grid.question().entrant(s.entrant); })},
      true};
  add_metrics(table, list);
  table.key = "families";
  return table;
}

Table ranking_table(const Scores& scores, const Grid& grid) {
  const std::vector<Rank>& list = scores.ranking;
  Table table{"ranking",
              {text_column("method", list, [&](const Rank& r) { return grid.question().entrant(r.entrant); }),
               column("rank_from", "", list, &Rank::from), column("rank_to", "", list, &Rank::to),
               column("interval_score", "", list, &Rank::interval_score),
               column("interval_score_se", "", list, &Rank::interval_score_se)}};
  table.is_long = true;  // a terminal shows the short table
  add_metrics(table, list);
  table.key = "ranking";
  return table;
}

Table difference_table(const Scores& scores, const Grid& grid) {
  const std::vector<Difference>& list = scores.differences;
  Table table{
      "differences",
      {text_column("better", list, [&](const Difference& d) { return grid.question().entrant(d.better); }),
       text_column("worse", list, [&](const Difference& d) { return grid.question().entrant(d.worse); }),
       column("difference", "", list, &Difference::value), column("difference_se", "", list, &Difference::se),
       column("significant", "", list, [](const Difference& d) { return d.is_significant ? 1.0 : 0.0; })},
      true};
  table.columns.back().kind = scenarios::CellKind::truth;
  table.key = "differences";
  return table;
}

Table by_consequence_table(const Scores& scores, const Grid& grid) {
  const std::vector<ConsequenceScore>& list = scores.by_consequence;
  Table table{
      "by_consequence",
      {text_column("of", list, [](const ConsequenceScore& s) { return s.axis; }),
       column("from", "", list, &ConsequenceScore::from), column("to", "", list, &ConsequenceScore::to),
       text_column("method", list, [&](const ConsequenceScore& s) { return grid.question().entrant(s.entrant); }),
       column("departures", "", list, &ConsequenceScore::departures),
       column("cases", "", list, &ConsequenceScore::cases)},
      true};
  add_metrics(table, list);
  table.key = "by_consequence";
  return table;
}

Table consequence_table(const MarkedCases& cases, const Grid& grid) {
  const StressTest& question = grid.question();
  std::vector<std::size_t> rows(cases.consequences.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  const auto motion = [&](std::size_t row) { return grid.motion(row / question.sensors.size()); };
  const auto number = [&](double CaseConsequence::* member) {
    return [&cases, member](std::size_t row) { return cases.consequences[row].*member; };
  };
  const auto rig = [&](std::size_t row) -> const TrueRig& { return question.rigs[motion(row).rig]; };
  Table table{"consequences",
              {text_column("law", rows, [&](std::size_t r) { return motion(r).departure.name(); }),
               column("severity", "", rows, [&](std::size_t r) { return motion(r).severity; }),
               column("rig", "", rows, [&](std::size_t r) { return static_cast<double>(motion(r).rig); }),
               text_column("range", rows, [&](std::size_t r) { return question.ranges[motion(r).range].name; }),
               text_column("sensors", rows,
                           [&](std::size_t r) { return question.sensors[r % question.sensors.size()].name; }),
               column("zeta", "", rows, [&](std::size_t r) { return rig(r).parameters().zeta; }),
               column("F0", "N", rows, [&](std::size_t r) { return rig(r).parameters().F0; }),
               column("distance", "", rows, number(&CaseConsequence::distance)),
               column("harm", "", rows, number(&CaseConsequence::harm)),
               column("harm_zeta", "", rows, number(&CaseConsequence::harm_zeta)),
               column("harm_F0", "", rows, number(&CaseConsequence::harm_F0)),
               column("attainable_power", "", rows, number(&CaseConsequence::attainable_power)),
               column("cramer_rao_zeta", "", rows, number(&CaseConsequence::cramer_rao_zeta)),
               column("cramer_rao_F0", "", rows, number(&CaseConsequence::cramer_rao_F0))},
              true};
  table.key = "consequences";
  return table;
}

Table departure_table(const Grid& grid) {
  const std::vector<Departure>& list = grid.question().departures;
  Table table{"departures",
              {text_column("departure", list, [](const Departure& d) { return d.name(); }),
               text_column("family", list, [](const Departure& d) { return name_of(d.family()); }),
               text_column("severity", list, [](const Departure& d) { return d.severity(); })},
              true};
  table.key = "departures";
  return table;
}

/// The columns of the ranking that fit a terminal.
Table short_ranking(const Scores& scores, const Grid& grid) {
  const std::vector<Rank>& list = scores.ranking;
  Table table{"ranking",
              {text_column("method", list, [&](const Rank& r) { return grid.question().entrant(r.entrant); }),
               column("rank_from", "", list, &Rank::from), column("rank_to", "", list, &Rank::to),
               column("interval_score", "", list, &Rank::interval_score),
               column("interval_score_se", "", list, &Rank::interval_score_se)}};
  for (const Metric metric : {Metric::coverage_zeta, Metric::coverage_F0, Metric::power, Metric::attainable_power,
                              Metric::false_alarm, Metric::prediction_error})
    table.columns.push_back(
        column(std::string(name_of(metric)), "", list, [metric](const Rank& r) { return r.value[metric]; }));
  table.is_file = false;
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

/// The fields of a metric and its standard error in a list of the result.
void add_metric_fields(std::vector<scenarios::ResultField>& fields, const std::string& list) {
  for (const MetricText& metric : metric_list) {
    const std::string path = list + "[]." + std::string(metric.name);
    fields.push_back({path, "1", std::string(metric.meaning)});
    fields.push_back({path + "_se", "1", "its standard error"});
  }
}

void add_consequence_fields(std::vector<scenarios::ResultField>& fields) {
  for (const auto& [name, unit, meaning] :
       {std::tuple("law", "", "departure, or coulomb_viscous"),
        std::tuple("severity", "1", "severity of the departure"),
        std::tuple("rig", "1", "number of the rig, from 0"), std::tuple("range", "", "range of excitation"),
        std::tuple("sensors", "", "sensors"), std::tuple("zeta", "1", "damping ratio of the rig"),
        std::tuple("F0", "N", "friction force of the rig"),
        std::tuple("distance", "1",
                   "distance of the readings from those of the nearest Coulomb and viscous motion, in units of "
                   "noise"),
        std::tuple("harm", "1", "largest relative error of zeta and F0 of that motion"),
        std::tuple("harm_zeta", "1", "relative error of zeta of that motion"),
        std::tuple("harm_F0", "1", "relative error of F0 of that motion"),
        std::tuple("attainable_power", "1", "power of the best test that knows the departure"),
        std::tuple("cramer_rao_zeta", "1", "smallest relative standard deviation of zeta if the law is known"),
        std::tuple("cramer_rao_F0", "1", "the same of F0")})
    fields.push_back({"consequences[]." + std::string(name), unit, meaning});
}

}  // namespace

scenarios::Answer answer_of(const MarkedCases& cases, const Grid& grid) {
  const Scores scores = score(cases, grid);
  scenarios::Answer answer;
  answer.result = summary(cases, grid);
  answer.tables = {short_ranking(scores, grid), ranking_table(scores, grid),    family_table(scores, grid),
                   departure_table(grid),       difference_table(scores, grid), by_consequence_table(scores, grid),
                   cell_table(scores, grid),    consequence_table(cases, grid)};
  if (cases.failed_cases > 0) answer.status = core::ExitStatus::some_cases_failed;
  return answer;
}

std::vector<scenarios::ResultField> score_fields() {
  std::vector<scenarios::ResultField> fields = {
      {"cases.all", "1", "cases of the grid"},
      {"cases.failed", "1", "cases without an estimate by any method"},
      {"cases.motions", "1", "motions computed for them"},
      {"cases.rigs", "1", "rigs"},
      {"cases.estimates", "1", "cases times methods and entries"},
      {"ranking[].method", "", "a method or an entry, best first"},
      {"ranking[].rank_from", "1", "1 + number of those that are better by more than two standard errors"},
      {"ranking[].rank_to", "1", "number of those that are not worse by more than two standard errors"},
      {"ranking[].interval_score", "1", "mean of the interval scores of zeta and F0, by which the ranking is made"},
      {"ranking[].interval_score_se", "1", "its standard error"}};
  add_metric_fields(fields, "ranking");
  fields.push_back({"departures[].departure", "", "name of the departure"});
  fields.push_back({"departures[].family", "", "what it changes, such as friction or the drive"});
  fields.push_back({"departures[].severity", "", "what its severity means"});
  fields.push_back({"families[].family", "", "family of departures, or none"});
  fields.push_back({"families[].method", "", "a method or an entry"});
  add_metric_fields(fields, "families");
  for (const auto& [name, unit, meaning] :
       {std::tuple("of", "", "distance or harm"),
        std::tuple("from", "1", "smallest distance or harm of these cases"),
        std::tuple("to", "1", "their distance or harm is below this; null: no limit"),
        std::tuple("method", "", "a method or an entry"),
        std::tuple("departures", "1", "departures that have such cases"),
        std::tuple("cases", "1", "number of these cases")})
    fields.push_back({"by_consequence[]." + std::string(name), unit, meaning});
  add_metric_fields(fields, "by_consequence");
  for (const auto& [name, unit, meaning] :
       {std::tuple("differences[].better", "", "the better of two"),
        std::tuple("differences[].worse", "", "the other"),
        std::tuple("differences[].difference", "1", "difference of their interval scores"),
        std::tuple("differences[].difference_se", "1", "its standard error"),
        std::tuple("differences[].significant", "", "whether it exceeds two standard errors"),
        std::tuple("scores[].family", "", "family of the departure, or none"),
        std::tuple("scores[].law", "", "departure, or coulomb_viscous"),
        std::tuple("scores[].severity", "1", "severity of the departure"),
        std::tuple("scores[].range", "", "range of excitation"), std::tuple("scores[].sensors", "", "sensors"),
        std::tuple("scores[].method", "", "a method or an entry"),
        std::tuple("scores[].cases", "1", "rigs times seeds"),
        std::tuple("scores[].estimates", "1", "cases with an estimate"),
        std::tuple("scores[].distance", "1", "mean distance over the rigs, in units of the sensors' noise"),
        std::tuple("scores[].harm", "1", "mean harm over the rigs"),
        std::tuple("scores[].zeta_bias", "1", "mean error of zeta, relative"),
        std::tuple("scores[].F0_bias", "1", "mean error of F0, relative"),
        std::tuple("scores[].zeta_error", "1", "median of the absolute error of zeta, relative"),
        std::tuple("scores[].F0_error", "1", "median of the absolute error of F0, relative")})
    fields.push_back({name, unit, meaning});
  add_metric_fields(fields, "scores");
  add_consequence_fields(fields);
  return fields;
}

}  // namespace dualdamp::bench
