#include "generalise/series/scale_series.h"

#include "generalise/series/change.h"
#include "interpret/plan/plan.h"
#include "io/levels/level_file.h"
#include "io/levels/written_grid.h"
#include "io/records/operation_log.h"
#include "io/writer.h"
#include "kernel/validate/validate.h"
#include "tests/generalise/line.h"
#include "tests/support/generated.h"
#include "tests/support/segmented.h"
#include "tests/support/shapes.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

const std::vector<double> kSeriesScales{500, 1000, 2500, 5000, 10000};

/// What the default pack asks for.
class PackOrder : public SeriesOrder {
 public:
  explicit PackOrder(const Line& line) : line_(line) {}
  [[nodiscard]] Plan plan_at(double scale) const override { return line_.plan_at(scale); }

 private:
  const Line& line_;
};

/// The same, but no solid may have fewer facets.
class LeastFacets : public PackOrder {
 public:
  LeastFacets(const Line& line, std::size_t least) : PackOrder(line), least_(least) {}
  [[nodiscard]] std::optional<Issue> fault_of(const Solid& solid) const override {
    if (solid.facets.size() >= least_) return std::nullopt;
    return building_issue(Severity::error, Code::G410, "house", "too few");
  }

 private:
  std::size_t least_;
};

/// Each step from its scale on.
class StepsFrom : public SeriesOrder {
 public:
  void add(double scale, Step step) { steps_.emplace_back(scale, std::move(step)); }
  [[nodiscard]] Plan plan_at(double scale) const override {
    Plan plan{scale, {}, {}};
    for (const auto& [from, step] : steps_)
      if (scale >= from) plan.steps.push_back(step);
    return plan;
  }

 private:
  std::vector<std::pair<double, Step>> steps_;
};

Checked<std::vector<SeriesLevel>> levels_of(const Line& line, const SeriesOrder& order) {
  return series_levels(line.context(), order, kSeriesScales);
}

ScaleSeries series_of(const Line& line, const SeriesOrder& order,
                      const std::vector<double>& bounds = plan_bounds(residential()),
                      Work* work = nullptr) {
  RedrawContext context = line.context();
  context.work = work;
  const auto levels = series_levels(context, order, kSeriesScales);
  REQUIRE(levels.value);
  const WrittenGrid grid(line.document);
  return scale_series(context, order, *levels.value, FiringScales(kSeriesScales, bounds, order),
                      [&](Vec3 local_m) { return grid.place(local_m, line.building().frame); });
}

ScaleSeries series_of(const Line& line) { return series_of(line, PackOrder(line)); }

/// Every prefix is a valid closed solid; all the way back gives the same states.
void check_both_ways(const Line& line, const ScaleSeries& series) {
  LevelState state = series.finest;
  std::vector<LevelState> states{state};
  double scale = 0;
  for (const SeriesOperation& operation : series.operations) {
    CHECK(operation.scale >= scale);
    scale = operation.scale;
    REQUIRE(apply(state, operation.forward));
    states.push_back(state);
    CAPTURE(operation.oriel_id);
    CHECK(is_closed(*labelled_building(state, line.building().frame).geometry));
    CHECK(validate(building_of(state, line.building().frame)).empty());
  }
  for (auto operation = series.operations.rbegin(); operation != series.operations.rend();
       ++operation) {
    CHECK(state == states.back());
    states.pop_back();
    REQUIRE(apply(state, operation->inverse));
  }
  CHECK(state == series.finest);
}

std::string log_of(const ScaleSeries& series) {
  std::string log;
  for (const SeriesOperation& operation : series.operations) log += operation_line(operation);
  return log;
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("a series goes down and up through valid solids to the same states") {
    std::size_t operations = 0;
    for (const std::string& name : samples()) {
      CAPTURE(name);
      const Line line = line_of_sample(name);
      const ScaleSeries series = series_of(line);
      check_both_ways(line, series);
      operations += series.operations.size();
    }
    CHECK(operations > 200);
  }

  TEST_CASE("a series of a generated house goes down and up") {
    for (int i = 0; i < 4; ++i) {
      CAPTURE(i);
      const Line line = line_of(generated({}, i).building);
      check_both_ways(line, series_of(line));
    }
  }

  TEST_CASE("a series of levels only has the same levels and goes down and up") {
    const Line line = line_of(generated({}, 1).building);
    const WrittenGrid grid(line.document);
    const auto levels = levels_of(line, PackOrder(line));
    REQUIRE(levels.value);
    const ScaleSeries only = level_series(
        *levels.value, [&](Vec3 local_m) { return grid.place(local_m, line.building().frame); });
    CHECK(only.operations.size() == kSeriesScales.size());
    check_both_ways(line, only);
    const ScaleSeries whole = series_of(line);
    for (const double scale : kSeriesScales) CHECK(state_at(only, scale) == state_at(whole, scale));
  }

  TEST_CASE("a series of houses of random3dcity goes down and up") {
    ORIEL_NEEDS_SHARED(shared);
    int houses = 0;
    for (const std::string& file : city_files(shared)) {
      if (file.find("random3dcity") == std::string::npos || !file.ends_with(".stripped.city.json"))
        continue;
      if (houses++ % 19 != 0) continue;
      CAPTURE(file);
      const Line line = line_of_file(file);
      check_both_ways(line, series_of(line));
    }
    CHECK(houses == 76);
  }

  TEST_CASE("a door that grows in a series takes windows aside and back") {
    const Line line = line_of(BoxBody()
                                  .add({0, 0, 0}, {10, 8, 6})
                                  .remove({4.5, 0, 0}, {5.5, 0.2, 2.2})
                                  .remove({3.2, 0, 1}, {4.2, 0.2, 2})
                                  .remove({5.8, 0, 1}, {6.8, 0.2, 2})
                                  .build());
    const auto openings =
        std::make_shared<const std::vector<FeatureId>>(all_features(line.segmentation));
    StepsFrom order;
    for (const FeatureId id : *openings)
      if (line.segmentation.features[id.index()].box.min.z == 0)
        order.add(
            1000,
            {id, "enlarge", "door", {{"to", 2}, {"gap", 0.3}}, {{"anchor", "sill"}}, {}, openings});
      else
        order.add(5000, {id, "omit", "window"});
    const ScaleSeries series = series_of(line, order, {1000, 5000});
    check_both_ways(line, series);
    REQUIRE(series.operations.size() == 3);
    CHECK(series.operations[0].operation == "enlarge");
    CHECK(series.operations[0].with.size() == 2);
  }

  TEST_CASE("the log and any level make every other level") {
    const Line line = line_of_sample("house");
    const ScaleSeries series = series_of(line);
    const auto log = read_operations(log_of(series), "log");
    REQUIRE(log.value);
    CHECK(log_of({{}, *log.value}) == log_of(series));
    const WrittenGrid grid(line.document, {state_at(series, 500)});
    for (const double from : kSeriesScales) {
      const LabelledBuilding level =
          labelled_building(state_at(series, from), line.building().frame);
      const std::string text = write_cityjson(line.document, {level},
                                              {.removed = {}, .finer_digits = grid.finer_digits()});
      auto read = read_level(text, "level", {line.building().id});
      REQUIRE(read.value);
      for (const double to : {1., 500., 700., 3000., 10000.}) {
        LevelState state = read.value->at(0);
        REQUIRE(move_state(state, *log.value, from, to));
        CHECK(state == state_at(series, to));
      }
    }
  }

  TEST_CASE("a level that must not be written stays as the one before and is told") {
    const Line line = line_of_sample("house");
    const auto free = levels_of(line, PackOrder(line));
    REQUIRE(free.value);
    const auto facets_at = [](const SeriesLevel& level) {
      return level.redrawn.labelled.geometry->facets.size();
    };
    const std::size_t least = facets_at(free.value->at(2)) - 1;
    CHECK(facets_at(free.value->at(3)) < least);
    const LeastFacets order(line, least);
    const auto levels = levels_of(line, order);
    REQUIRE(levels.value);
    for (const std::size_t i : {2, 3, 4, 5}) {
      CHECK(facets_at(levels.value->at(i)) == facets_at(free.value->at(2)));
      CHECK(levels.value->at(i).scale == kSeriesScales[i - 1]);
    }
    CHECK(std::ranges::count(levels.issues, Code::G410, &Issue::code) == 3);
    CHECK_FALSE(has_errors(levels.issues));
    const ScaleSeries series = series_of(line, order);
    check_both_ways(line, series);
    CHECK(state_at(series, 1000) == state_at(series, 10000));
    CHECK_FALSE(state_at(series, 1) == state_at(series, 1000));
  }

  TEST_CASE("a building that must not be written as it came has no series") {
    const Line line = line_of_sample("house");
    const auto levels = levels_of(line, LeastFacets(line, line.solid.facets.size() + 1));
    CHECK_FALSE(levels.value);
    CHECK(has_errors(levels.issues));
  }

  TEST_CASE("levels and the states between are finished as the order asks") {
    struct Finished : PackOrder {
      using PackOrder::PackOrder;
      void finish(LabelledBuilding& level) const override {
        for (SemanticSurface& surface : level.surfaces)
          surface.label = FeatureLabel{.others = {{"finished", true}}};
      }
    };
    const Line line = line_of_sample("house");
    const ScaleSeries series = series_of(line, Finished(line));
    check_both_ways(line, series);
    LevelState state = series.finest;
    for (const SeriesOperation& operation : series.operations) {
      for (const auto& [outer, facet] : state.facets)
        CHECK(facet.label->others == Members{{"finished", true}});
      REQUIRE(apply(state, operation.forward));
    }
  }

  TEST_CASE("what a level shows of a feature has the same id and label in all levels") {
    const Line line = line_of_sample("house");
    const ScaleSeries series = series_of(line);
    const auto ids = [](const LevelState& state) {
      std::set<std::string> found;
      for (const auto& [outer, facet] : state.facets)
        if (!facet.label->id.empty()) found.insert(facet.label->id);
      for (const auto& [id, label] : state.installations) found.insert(id);
      return found;
    };
    std::set<std::string> finer = ids(series.finest), gone;
    CHECK(finer.size() > 20);
    for (const SeriesOperation& operation : series.operations) {
      gone.insert(operation.oriel_id);
      gone.insert(operation.with.begin(), operation.with.end());
    }
    for (const double scale : kSeriesScales) {
      const std::set<std::string> coarser = ids(state_at(series, scale));
      CHECK(std::ranges::includes(finer, coarser));
      for (const std::string& id : finer)
        if (!coarser.contains(id)) CHECK(gone.contains(id));
      finer = coarser;
    }
  }

  TEST_CASE("a log that does not fit the level is refused") {
    const Line line = line_of_sample("house");
    ScaleSeries series = series_of(line);
    LevelState state = series.finest;
    std::swap(series.operations.front(), series.operations.back());
    LevelState changed = state;
    changed.facets.erase(changed.facets.begin());
    CHECK_FALSE(move_state(changed, series.operations, 0, 1e6));
    const auto bad = read_operations("{\"building\":\"a\"}\n", "log");
    CHECK_FALSE(bad.value);
    REQUIRE(bad.issues.size() == 1);
    CHECK(bad.issues[0].code == Code::E119);
    const auto none = read_level("{}", "level", {"a"});
    CHECK_FALSE(none.value);
    CHECK(none.issues.at(0).code == Code::E120);
  }

  TEST_CASE("a body that is there twice has no state") {
    const Line line = line_of_sample("block");
    LabelledBuilding twice = levels_of(line, PackOrder(line)).value->at(0).redrawn.labelled;
    const auto place = [](Vec3 p) {
      return MicrometrePoint{std::llround(1e6 * p.x), std::llround(1e6 * p.y),
                             std::llround(1e6 * p.z)};
    };
    const LevelState state = level_state(twice, place);
    CHECK(state.facets.size() == twice.geometry->facets.size());
    twice.geometry->facets.push_back(twice.geometry->facets[0]);
    twice.surface_of_polygon.push_back(twice.surface_of_polygon[0]);
    CHECK_THROWS_AS(level_state(twice, place), DoubledFacet);
  }

  TEST_CASE("with any work the levels of a series go one way and its operations lead to them") {
    for (const std::int64_t budget : {1, 10'000, 100'000, 1'000'000, 3'000'000, 10'000'000}) {
      CAPTURE(budget);
      const Line line = line_of_sample("house");
      Work work(budget);
      const ScaleSeries series =
          series_of(line, PackOrder(line), plan_bounds(residential()), &work);
      check_both_ways(line, series);
      if (budget == 1) CHECK(series.operations.empty());
    }
  }
}
