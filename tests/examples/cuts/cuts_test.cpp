#include "examples/cuts/outlines.h"
#include "examples/cuts/shot.h"
#include "examples/cuts/svg.h"
#include "tests/support/houses.h"
#include "tests/support/segmented.h"

#include <set>
#include <string>

#include <doctest/doctest.h>

namespace oriel::cuts {
namespace {

double volume_of(const Segmentation& s, const std::vector<Piece>& pieces) {
  double volume = 0;
  for (const Piece& piece : pieces) volume += piece.sign * s.cells[piece.cell.index()].volume_m3;
  return volume;
}

/// How many samples show parts, and how many the rest.
struct Samples {
  int parts = 0, rest = 0;
};

Samples count(const Image& image) {
  Samples samples;
  for (const int label : image.labels)
    if (label > 0)
      ++(image.surfaces[static_cast<std::size_t>(label) - 1].is_part ? samples.parts
                                                                     : samples.rest);
  return samples;
}

/// The building before its first cut; ten samples a metre.
Image first_view(const Building& building, const Camera& eye) {
  const Segmentation s = test::in_paper_order(building).segmentation;
  const std::vector<Piece> pieces = pieces_of(s, s.root);
  const Box box = extent_of(s, pieces, eye);
  return view(s, pieces, eye, {(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2, 10}, 160,
              120);
}

double area_of(const std::vector<Outline>& outlines) {
  double doubled = 0;
  for (const Outline& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const auto [x, y] = outline[i];
      const auto [u, v] = outline[(i + 1) % outline.size()];
      doubled += static_cast<double>(x) * v - static_cast<double>(u) * y;
    }
  return doubled / 2;
}

TEST_SUITE("examples/cuts") {
  TEST_CASE("the pieces at every node make the body of that node") {
    for (const test::NamedBody& body : test::bodies()) {
      CAPTURE(body.name);
      const test::Segmented s = test::in_paper_order(body.make());
      const Segmentation& result = s.segmentation;
      CHECK(volume_of(result, pieces_of(result, result.root)) ==
            doctest::Approx(volume_m3(s.solid)));
      for (const CsgNode& node : result.nodes) {
        if (node.kind == CsgNode::Kind::leaf) continue;
        double volume = 0;
        for (const NodeId rest : node.rest) volume += volume_of(result, pieces_of(result, rest));
        for (const NodeId part : node.parts)
          volume += (node.kind == CsgNode::Kind::subtract ? -1 : 1) *
                    volume_of(result, pieces_of(result, part));
        const auto self = static_cast<int>(&node - result.nodes.data());
        CHECK(volume == doctest::Approx(volume_of(result, pieces_of(result, {self}))));
      }
    }
  }

  TEST_CASE("steps go down the rest to its leaf and name every inner node of it once") {
    const Segmentation s = test::segmented(test::full_house(), Order::paper).segmentation;
    const std::vector<Step> steps = steps_of(s);
    std::set<NodeId> nodes;
    for (const Step& step : steps) nodes.insert(step.node);
    CHECK(nodes.size() == steps.size());
    CHECK(steps.size() == s.stats.inner + 1);
    CHECK(steps.front().node == s.root);
    CHECK(s.nodes[steps.back().node.index()].kind == CsgNode::Kind::leaf);
  }

  TEST_CASE("protrusions are seen in full and of holes their walls") {
    const Camera from_above = camera(0, 90);
    const Samples slab = count(first_view(test::two_boxes_on_a_slab(), from_above));
    CHECK(slab.parts == 400);  // two boxes of 1 m x 2 m
    CHECK(slab.rest == 2800);
    const Samples pocket = count(first_view(test::pocket(), from_above));
    CHECK(pocket.parts == 100);  // the floor, 1 m x 1 m
    CHECK(pocket.rest == 1500);
  }

  TEST_CASE("a body has the same outline from opposite sides") {
    for (const test::NamedBody& body : test::bodies()) {
      CAPTURE(body.name);
      for (const double azimuth : {20.0, 75.0, 130.0}) {
        const Samples front = count(first_view(body.make(), camera(azimuth, 25)));
        const Samples back = count(first_view(body.make(), camera(azimuth + 180, -25)));
        CHECK(front.parts + front.rest == doctest::Approx(back.parts + back.rest).epsilon(0.01));
      }
    }
  }

  TEST_CASE("outlines without smoothing hold just the samples of their label") {
    const Image image = first_view(test::full_house(), camera(32, 24));
    std::vector<int> samples(image.surfaces.size() + 1);
    for (const int label : image.labels) ++samples[static_cast<std::size_t>(label)];
    const auto lines = outlines(image, 0);
    for (std::size_t label = 1; label < lines.size(); ++label)
      CHECK(area_of(lines[label]) == doctest::Approx(samples[label]));
  }

  TEST_CASE("smoothed outlines of neighbours share their lines") {
    const Image image = first_view(test::pocket(), camera(32, 60));
    const auto lines = outlines(image, 1.1);
    std::set<std::pair<Corner, Corner>> segments;
    const auto each = [](const std::vector<Outline>& of, const auto& act) {
      for (const Outline& outline : of)
        for (std::size_t i = 0; i < outline.size(); ++i)
          act(outline[i], outline[(i + 1) % outline.size()]);
    };
    for (const auto& of : lines) each(of, [&](Corner p, Corner q) { segments.emplace(p, q); });
    int inner = 0;
    // What is seen of the pocket has neighbours all around.
    for (std::size_t label = 1; label < lines.size(); ++label)
      if (image.surfaces[label - 1].is_part)
        each(lines[label], [&](Corner p, Corner q) {
          ++inner;
          CHECK(segments.contains({q, p}));
        });
    CHECK(inner >= 9);
  }

  TEST_CASE("a picture has a panel a step with kind and order and v") {
    const Segmentation s = test::segmented(test::full_house(), Order::paper).segmentation;
    const std::string picture = draw_cuts(s);
    for (const char* text :
         {"1. the building, from", "1 protrusion, k = 1, v = 0.0030", "5 holes, k = 1, v = 0.0298",
          "1 hole, k = 2, v = 0.0174", "9. the rest of 8", "a leaf: convex"})
      CHECK_MESSAGE(picture.find(text) != std::string::npos, text);
    CHECK(picture.find("10. ") == std::string::npos);
    CHECK(picture == draw_cuts(s));
  }
}

}  // namespace
}  // namespace oriel::cuts
