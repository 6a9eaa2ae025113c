#include "kernel/base/log.h"
#include "oriel/oriel.h"
#include "tests/cli/command.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using oriel::test::bytes_of;
using oriel::test::Folder;
using oriel::test::sample;

namespace {

std::vector<Document> records_of(const std::string& name) {
  return read(sample(name)).value.value();
}

const RuleBase& residential() {
  static const RuleBase rules = load_pack_file("residential").value.value();
  return rules;
}

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("reading a file that is not there throws E101") {
    try {
      read("/no/such/file.city.json");
      FAIL("nothing was thrown");
    } catch (const InputError& error) {
      CHECK(error.issue().code == Code::E101);
    }
  }

  TEST_CASE("a building that cannot be a solid is rejected with an error and without output") {
    Document document;
    Building& building = document.buildings.emplace_back();
    building.id = "nothing";
    const PipelineResult result = label(building, residential());
    CHECK(!result.is_done());
    CHECK(has_errors(result.issues));
    CHECK(result.output.building.empty());
    CHECK(generalise(document, building, result, residential(), at_scale(1000)).levels.empty());
    CHECK(!repair(document, building).solid);
  }

  TEST_CASE("a building without its largest wall has the features that it had") {
    const auto records = records_of("house");
    const Building& whole = records[0].buildings.at(0);
    Building open = whole;
    const auto most_windows = std::ranges::max_element(
        open.polygons, {}, [](const Polygon& polygon) { return polygon.rings.size(); });
    REQUIRE(most_windows->rings.size() > 2);
    open.polygons.erase(most_windows);
    open.is_solid = false;

    // By default the wall is closed; where it may not be it is supposed.
    GeneraliseOptions planar;
    planar.repair.close = Closing::planar;
    const PipelineResult closed = label(whole, residential()),
                         result = label(open, residential(), planar),
                         made = label(open, residential());
    CHECK_FALSE(made.is_open());
    CHECK(std::ranges::count(made.issues, Code::E316, &Issue::code) == 1);
    CHECK_FALSE(made.output.geometry.has_value());
    CHECK(generalise(records[0], open, made, residential(), at_scale(1000)).levels.size() == 1);
    CHECK(result.is_open());
    CHECK(result.body == BodyKind::supposed_solid);
    CHECK(std::ranges::count(result.issues, Code::E319, &Issue::code) == 1);
    REQUIRE(result.segmentation.has_value());  // what `segment --json` says
    CHECK(std::ranges::count(result.segmentation->issues, Code::E319, &Issue::code) == 1);
    CHECK(std::ranges::count(result.issues, Code::E302, &Issue::code) == 1);
    CHECK_FALSE(has_errors(result.issues));
    CHECK(result.description.table.rows() == closed.description.table.rows());
    const auto labels_of = [](const PipelineResult& of) {
      std::multiset<std::string> labels;
      for (const Verdict& verdict : of.interpretation.verdicts) labels.insert(verdict.label);
      return labels;
    };
    CHECK(labels_of(result) == labels_of(closed));
    CHECK(labels_of(made) == labels_of(closed));
    // What is supposed is nobody's surface: it is not written, and nothing is redrawn from it.
    CHECK_FALSE(result.output.geometry.has_value());
    const auto drawn = generalise(records[0], open, result, residential(), at_scale(1000), planar);
    CHECK(drawn.levels.empty());
    CHECK(std::ranges::count(drawn.issues, Code::G404, &Issue::code) == 1);

    LabelOptions none;
    none.repair.close = Closing::none;
    const PipelineResult rings = label(open, residential(), none);
    CHECK(rings.is_open());
    CHECK(rings.body == BodyKind::open_shell);
  }

  TEST_CASE("a drawing that nobody waits for is given up wherever it stands") {
    const auto records = records_of("house");
    const Building& building = records[0].buildings.at(0);
    const PipelineResult labelled = label(building, residential());
    GeneraliseOptions options;
    options.reports_changes = options.reports_figures = true;
    const auto drawn = [&](std::function<bool(Stage)> is_given_up) {
      options.is_given_up = std::move(is_given_up);
      return generalise(records[0], building, labelled, residential(), at_scale(5000), options);
    };
    int asked = 0;
    const auto whole = drawn([&](Stage) { return ++asked < 0; });
    CHECK_FALSE(whole.is_given_up);
    CHECK(whole.levels.size() == 1);
    CHECK(whole.issues.size() == drawn(nullptr).issues.size());
    CHECK(asked > 3);
    for (int most = 0; most < asked; most = 2 * most + 1) {
      int count = 0;
      const auto made = drawn([&](Stage) { return count++ == most; });
      CHECK(made.is_given_up);
      CHECK(made.building == building.id);
      CHECK((made.levels.empty() && made.reports.empty() && made.issues.empty()));
      CHECK(count == most + 1);
    }
  }

  TEST_CASE("the observer hears of every stage and changes nothing") {
    const auto records = records_of("house");
    const Building& building = records[0].buildings.at(0);
    std::set<Stage> stages;
    LabelOptions options;
    options.observer = [&](Stage stage, double ms) {
      CHECK(ms >= 0);
      stages.insert(stage);
    };
    OutputRecord quiet, observed;
    add(label(building, residential()).output, quiet);
    add(label(building, residential(), options).output, observed);
    CHECK(stages == std::set{Stage::solidify, Stage::segment, Stage::describe, Stage::interpret});
    CHECK(write(records[0], quiet) == write(records[0], observed));
  }

  TEST_CASE("the library logs nothing unless the program registers loggers") {
    const auto records = records_of("house");
    label(records[0].buildings.at(0), residential());
    for (const char* room : {"kernel", "interpret", "generalise", "oriel"})
      CHECK_FALSE(log(room).is_on(LogLevel::error));
  }

  TEST_CASE("output that is made later is that of label") {
    const auto records = records_of("house");
    const Building& building = records[0].buildings.at(0);
    LabelOptions later;
    later.has_output = false;
    const PipelineResult result = label(building, residential(), later);
    CHECK(result.output.building.empty());
    OutputRecord at_once, made_later;
    add(label(building, residential()).output, at_once);
    add(annotate(building, result, residential(), later), made_later);
    CHECK(write(records[0], at_once) == write(records[0], made_later));
  }

  TEST_CASE("label warns of the features that the pack does not emit") {
    const auto records = records_of("house");
    const Building& building = records[0].buildings.at(0);
    const auto pack = load_pack(
        "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {opening: {}}\n"
        "rules: [{id: o, label: opening, require: sense = hole}]\n",
        "t.yaml");
    const PipelineResult result = label(building, pack.value.value());
    const int openings = count_labels(result.interpretation).at("opening");
    const auto issue = std::ranges::find(result.issues, Code::R258, &Issue::code);
    REQUIRE(issue != result.issues.end());
    CHECK(std::ranges::count(result.issues, Code::R258, &Issue::code) == 1);
    CHECK(issue->severity == Severity::warning);
    CHECK(to_string(*issue).starts_with(
        "t.yaml:3:11: house: R258 " + std::to_string(openings) +
        " features with the label 'opening' are written without a type, a protrusion "
        "as a generic BuildingInstallation, anything else by the label of its surfaces: the "
        "class has no 'emit'; add emit: {opening: {type: BuildingInstallation}}\n"));
    LabelOptions none;
    none.has_output = false;
    const PipelineResult quiet = label(building, pack.value.value(), none);
    CHECK(std::ranges::count(quiet.issues, Code::R258, &Issue::code) == 0);
    const PipelineResult complete = label(building, residential());
    CHECK(std::ranges::count(complete.issues, Code::R258, &Issue::code) == 0);
  }

  TEST_CASE("a feature is found by the beginning of its id and explained") {
    const auto records = records_of("house");
    const Building& building = records[0].buildings.at(0);
    LabelOptions options;
    options.measures_surfaces = true;
    const PipelineResult result = label(building, residential(), options);
    CHECK(find_features(result, "").size() == result.description.table.rows());
    const auto found = find_features(result, result.description.table.id(FeatureId{0}));
    REQUIRE(found.size() == 1);
    const Explanation why = explain(result, residential(), found[0]);
    CHECK(why.feature == result.description.table.id(FeatureId{0}));
    CHECK(explain_surface(building, result, residential(), 0).starts_with(building.id));
  }

  TEST_CASE("a feature is found by its name and all names are different") {
    const auto records = records_of("house");
    const PipelineResult result = label(records[0].buildings.at(0), residential());
    const std::vector<std::string> names = names_of_features(result);
    REQUIRE(names.size() == result.description.table.rows());
    for (std::size_t row = 0; row < names.size(); ++row) {
      const auto found = find_features(result, names[row]);
      REQUIRE(found.size() == 1);
      CHECK(found[0].index() == row);
      CHECK(explain(result, residential(), found[0]).name == names[row]);
    }
    CHECK(find_features(result, "window 1 of facade south").size() == 2);
    CHECK(find_features(result, "window 1 of the moon").empty());
    CHECK(names_of_features({}).empty());
  }

  TEST_CASE("all features and surfaces are explained as one by one") {
    const auto records = records_of("house");
    const Building& building = records[0].buildings.at(0);
    LabelOptions options;
    options.measures_surfaces = true;
    const PipelineResult result = label(building, residential(), options);
    const auto features = explain_features(result, residential());
    REQUIRE(features.size() == result.description.table.rows());
    CHECK(headline(features[0]) == headline(explain(result, residential(), FeatureId{0})));
    const auto surfaces = explain_surfaces(building, result, residential());
    REQUIRE(surfaces.size() == building.polygons.size());
    CHECK(explain_surface(building, result, residential(), 3).ends_with(surfaces[3].reason));
    CHECK(surfaces[3].reason.find(surfaces[3].type) != std::string::npos);
    CHECK(explain_features({}, residential()).empty());
    CHECK(explain_surfaces(building, {}, residential()).empty());
  }

  TEST_CASE("cells and the balanced tree are those of one body") {
    const auto records = records_of("house");
    const PipelineResult result = segment(records[0].buildings.at(0));
    CHECK(!cell_complex(result).faces().empty());
    const TreeComparison trees = compare_trees(result);
    CHECK(trees.is_same_body());
    CHECK(trees.cut.leaves == trees.balanced.leaves);
    CHECK(trees.merged.leaves <= trees.balanced.leaves);
  }

  TEST_CASE("cells are joined and trees compared as far as the budget goes") {
    const auto records = records_of("house");
    const PipelineResult result = segment(records[0].buildings.at(0));
    CHECK(!cell_complex(result, 1));
    CHECK(cell_complex(result, kWorkBudget)->faces().size() == cell_complex(result).faces().size());
    const TreeComparison whole = compare_trees(result), part = compare_trees(result, 1);
    CHECK(!whole.is_used_up);
    CHECK(part.is_used_up);
    CHECK(part.is_same_body());
    CHECK(part.balanced_proof.points < whole.balanced_proof.points);
  }

  TEST_CASE("stored features get the labels that the building gets") {
    const auto records = records_of("house");
    const Building& building = records[0].buildings.at(0);
    const PipelineResult labelled = label(building, residential());
    std::vector<FeatureRecord> stored = feature_records(building, segment(building));
    CHECK(stored[0].rule.empty());
    const PipelineResult features = segment(building);
    const std::vector<DescribedBuilding> buildings{
        {features.description.table, features.description.graph}};
    const auto run = interpret(residential(), buildings);
    REQUIRE(run.size() == 1);
    const auto expected = feature_records(building, labelled);
    RecordLabeller labeller(buildings, run);
    for (std::size_t i = 0; i < stored.size(); ++i) {
      CHECK(labeller.label(stored[i]));
      CHECK(stored[i].label == expected[i].label);
      CHECK(stored[i].rule == expected[i].rule);
    }
    FeatureRecord unknown;
    unknown.building = "nobody";
    CHECK(!labeller.label(unknown));
    CHECK(diff_labels(buildings, run, run).differences() == 0);
  }

  TEST_CASE("labels are scored against the truth by boxes and by area") {
    const auto records = records_of("house");
    const Building& building = records[0].buildings.at(0);
    LabelsAndTruth all;
    add(feature_records(building, label(building, residential())), all);
    const auto truths =
        read_truths(std::string(ORIEL_SOURCE_DIR) + "/examples/samples/house.truth.json");
    for (const GroundTruth& truth : truths.value.value()) add(truth, all);
    const auto buildings = score_by_building(all);
    REQUIRE(buildings.size() == 1);
    CHECK(total(buildings).macro_f1() > 0.9);
    CHECK(!precision_recall_curve(all).empty());
    AreaScore areas;
    CHECK(compare_areas(building, all, {}, areas));
    CHECK(areas.compared_m2 > 0);
    Building other;
    other.id = "other";
    CHECK(!compare_areas(other, all, {}, areas));
  }

  TEST_CASE("tests of a pack read their buildings") {
    const auto report =
        run_rule_tests(std::string(ORIEL_SOURCE_DIR) + "/rules/residential.test.yaml");
    REQUIRE(report.value);
    CHECK(report.value->failed() == 0);
    CHECK(!report.value->tests.empty());
  }

  TEST_CASE("a mesh file has what was gathered of all records") {
    const auto records = records_of("house");
    const Folder folder;
    MeshSource mesh;
    append_mesh(mesh, records[0], {});
    for (const auto& [name, format] : {std::pair("house.ply", Format::ply),
                                       {"house.obj", Format::obj},
                                       {"house.off", Format::off},
                                       {"house.stl", Format::stl}}) {
      write(folder / name, records, std::vector<OutputRecord>(1));
      CHECK(bytes_of(folder / name) == mesh_text(format, mesh));
    }
  }

  TEST_CASE("CityGML and GeoPackages are written and say what they lack") {
    const auto records = records_of("house");
    const Folder folder;
    const std::vector<OutputRecord> none(1);
    const auto codes = [](const std::vector<Issue>& issues) {
      return issues.size() == 1 ? to_string(issues[0].code) : std::to_string(issues.size());
    };
    CHECK(codes(write(folder / "two.gml", records, none)) == "E161");
    CHECK(codes(write(folder / "three.gml", records, none, {}, Format::citygml3)) == "E161");
    CHECK(codes(write(folder / "a.gpkg", records, none)) == "E161");
    CHECK(bytes_of(folder / "two.gml").find("citygml/2.0") != std::string::npos);
    CHECK(bytes_of(folder / "three.gml").find("citygml/3.0") != std::string::npos);
    CHECK(bytes_of(folder / "a.gpkg").starts_with("SQLite format 3"));
  }

  TEST_CASE("a name that says no format is refused with E106") {
    const auto records = records_of("house");
    const Folder folder;
    for (const char* name : {"house.txt", "house.ifc", "house.city.jsonl"}) {
      CAPTURE(name);
      CHECK_THROWS_AS(write(folder / name, records, std::vector<OutputRecord>(1)), InputError);
    }
    CHECK(folder.names().empty());
  }

  TEST_CASE("what nothing is added to is written as it was read") {
    const auto records = records_of("house");
    const Folder folder;
    write(folder / "same.city.json", records, std::vector<OutputRecord>(1));
    CHECK(bytes_of(folder / "same.city.json") == bytes_of(sample("house")));
  }

  TEST_CASE("a segmented building is labelled as if it was labelled at once") {
    const auto documents = records_of("house");
    const Building& building = documents.front().buildings.front();
    for (const bool measures : {false, true}) {
      LabelOptions options;
      options.measures_surfaces = measures;
      const PipelineResult once = label(building, residential(), options);
      const PipelineResult twice =
          label(building, segment(building, options), residential(), options);
      REQUIRE(once.interpretation.verdicts.size() == twice.interpretation.verdicts.size());
      for (std::size_t i = 0; i < once.interpretation.verdicts.size(); ++i) {
        CHECK(once.interpretation.verdicts[i].label == twice.interpretation.verdicts[i].label);
        CHECK(once.interpretation.verdicts[i].score == twice.interpretation.verdicts[i].score);
      }
      CHECK(once.issues.size() == twice.issues.size());
      OutputRecord p, q;
      add(once.output, p);
      add(twice.output, q);
      CHECK(write(documents.front(), p) == write(documents.front(), q));
    }
  }

  TEST_CASE("packs label alike where only words and what is not of labels differ") {
    const std::string text(embedded_pack("residential").value());
    const auto changed = [&](const std::string& what, const std::string& by) {
      std::string other = text;
      const std::size_t at = other.find(what);
      REQUIRE(at != std::string::npos);
      return load_pack(other.replace(at, what.size(), by), "residential.yaml").value.value();
    };
    CHECK(is_labelling_alike(residential(), residential()));
    CHECK(is_labelling_alike(residential(), changed("params:", "# a remark\nparams:")));
    CHECK(is_labelling_alike(residential(), changed("{id: vents.omit,", "{id: vents.go,")));
    CHECK(is_labelling_alike(residential(), changed("a parapet", "a low parapet")));
    CHECK_FALSE(is_labelling_alike(residential(), changed("{value: 0.9 m,", "{value: 0.8 m,")));
    CHECK_FALSE(is_labelling_alike(residential(), changed("window.in_wall", "window.in_a_wall")));
    CHECK_FALSE(is_labelling_alike(residential(), load_pack_file("surfaces-only").value.value()));
  }

  TEST_CASE("classes and rules and params of a pack stand where they are written") {
    const auto classes = classes_of(residential());
    const auto opening = std::ranges::find(classes, "opening", &ClassOfPack::name);
    const auto window = std::ranges::find(classes, "window", &ClassOfPack::name);
    REQUIRE(window != classes.end());
    CHECK(opening->is_abstract);
    CHECK(window->parent == opening - classes.begin());
    CHECK(opening->place.line < window->place.line);
    const auto rules = rules_of(residential());
    CHECK(rules.size() == residential().rule_count());
    CHECK(places_of_params(residential()).size() == params_of(residential()).size());
    for (const RuleOfPack& rule : rules) CHECK(rule.place.line > window->place.line);
  }

  TEST_CASE("a text with other values of params labels as the pack with them") {
    const std::string text(embedded_pack("residential").value());
    const std::vector<ParamValue> values{{"parapet", 0.7}, {"step", 0.25}};
    const auto wanted = with_params(residential(), values);
    const std::string own = text_with_params(residential(), text, values);
    CHECK(is_labelling_alike(*load_pack(own, "residential.yaml").value, *wanted.value));
    CHECK(std::ranges::count(own, '\n') == std::ranges::count(text, '\n'));
    for (const std::string& above :
         {std::string("schema: oriel/1\npack: {name: t, version: 1.0.0}\nextends: residential"),
          std::string("schema: oriel/1\npack: {name: t, version: 1.0.0}\nextends: residential\n"
                      "params:   # mine\n    # first\n    curb: {value: 0.5 m}\nrules: []\n"),
          std::string("schema: oriel/1\npack: {name: t, version: 1.0.0}\nextends: residential\n"
                      "params: {curb: {value: 0.5 m}}\n")}) {
      const auto base = load_pack(above, "t.yaml");
      REQUIRE(base.value);
      const auto expected = with_params(*base.value, values);
      const auto made = load_pack(text_with_params(*base.value, above, values), "t.yaml");
      REQUIRE(made.value);
      CHECK(is_labelling_alike(*made.value, *expected.value));
      CHECK_FALSE(is_labelling_alike(*made.value, *base.value));
    }
    CHECK(text_with_params(residential(), text, {}) == text);
  }

  TEST_CASE("a condition selects the features of which it holds") {
    const std::string text(embedded_pack("residential").value());
    const auto documents = records_of("house");
    const PipelineResult result = label(documents.front().buildings.front(), residential());
    const auto& [table, graph, issues] = result.description;
    const auto found = [&, &features = table, &links = graph](const std::string& condition) {
      const auto selection = read_selection(condition, text, "residential");
      REQUIRE(selection.value);
      return selection.value->find(features, links);
    };
    std::vector<FeatureId> windows, wide;
    for (const Verdict& verdict : result.interpretation.verdicts) {
      if (verdict.label == "window") windows.push_back(verdict.feature);
      if (table.number(verdict.feature, Attribute::width).value_or(0) > 1.5)
        wide.push_back(verdict.feature);
    }
    CHECK(found("self is window") == windows);
    CHECK(found("width > 1.5 m") == wide);
    CHECK(found("width > 1.5 m and width < 1 m").empty());
    const auto misspelt = read_selection("width > 1 m and heigth > 1 m", text, "residential");
    CHECK_FALSE(misspelt.value);
    REQUIRE(misspelt.issues.size() == 1);
    CHECK(misspelt.issues[0].code == Code::R204);
    CHECK(misspelt.issues[0].place.column == 17);
    for (const char* wrong : {"", "it's", "a\nb", "]}", "width", "width > 1 deg"})
      CHECK(has_errors(read_selection(wrong, text, "residential").issues));
    CHECK(has_errors(read_selection("width > 1 m", "no pack", "residential").issues));
  }

  TEST_CASE("of every label without a rule that holds the nearest miss is known") {
    const auto documents = records_of("house");
    const PipelineResult result = label(documents.front().buildings.front(), residential());
    const Explanation explanation = explain(result, residential(), FeatureId{0});
    REQUIRE(explanation.near_misses.size() > 3);
    CHECK(explanation.nearest_miss->rule == explanation.near_misses.front().rule);
    CHECK(std::ranges::is_sorted(explanation.near_misses, {}, &NearestMiss::gap));
    std::set<std::string> labels;
    for (const NearestMiss& near : explanation.near_misses) {
      CHECK_FALSE(near.misses.empty());
      CHECK(labels.insert(explanation.rules[near.rule].label).second);
      CHECK(explanation.rules[near.rule].label != explanation.verdict.label.text());
    }
  }
}
