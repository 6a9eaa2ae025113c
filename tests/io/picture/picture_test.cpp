#include "io/picture/picture.h"

#include "io/mesh/label_colours.h"
#include "io/picture/raster.h"
#include "io/picture/visible.h"

#include <cmath>
#include <expat.h>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

/// Adds a box from `low` to `high` as polygons of a feature.
void add_box(MeshSource& mesh, Vec3 low, Vec3 high, const std::string& label) {
  const int first = static_cast<int>(mesh.points.size());
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                           (i & 4) != 0 ? high.z : low.z});
  const int feature = static_cast<int>(mesh.features.size());
  mesh.features.push_back({"b", label, label + std::to_string(feature)});
  const std::vector<std::pair<std::vector<int>, Vec3>> faces{
      {{0, 2, 3, 1}, {0, 0, -1}}, {{4, 5, 7, 6}, {0, 0, 1}},  {{0, 1, 5, 4}, {0, -1, 0}},
      {{2, 6, 7, 3}, {0, 1, 0}},  {{0, 4, 6, 2}, {-1, 0, 0}}, {{1, 3, 7, 5}, {1, 0, 0}}};
  for (const auto& [corners, normal] : faces) {
    MeshPolygon polygon{{corners}, normal, feature};
    for (int& corner : polygon.rings.front()) corner += first;
    mesh.polygons.push_back(std::move(polygon));
  }
}

/// Boxes one behind the other, through each other and flush with each other.
MeshSource boxes() {
  MeshSource mesh;
  add_box(mesh, {0, 0, 0}, {10, 8, 6}, "wall");
  add_box(mesh, {3, -1, 2}, {5, 4, 9}, "chimney");
  add_box(mesh, {7, 0, 1}, {8, 1, 3}, "window");
  add_box(mesh, {-4, 12, 0}, {6, 15, 11}, "garage");
  return mesh;
}

std::string drawn(const MeshSource& mesh, PictureFormat format, const PictureOptions& options) {
  const auto made = picture({{.mesh = mesh}}, format, options);
  REQUIRE(made.value);
  return *made.value;
}

std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

/// How often each element of an XML text occurs; none if it is not well-formed.
std::map<std::string, int> elements_in(const std::string& text) {
  std::map<std::string, int> counts;
  XML_Parser parser = XML_ParserCreate(nullptr);
  XML_SetUserData(parser, &counts);
  XML_SetStartElementHandler(parser, [](void* to, const char* name, const char**) {
    ++(*static_cast<std::map<std::string, int>*>(to))[name];
  });
  const auto status = XML_Parse(parser, text.data(), static_cast<int>(text.size()), 1);
  XML_ParserFree(parser);
  return status == XML_STATUS_OK ? counts : std::map<std::string, int>{};
}

}  // namespace

TEST_SUITE("io") {
  TEST_CASE("what a picture of pixels and one of outlines show of each face is as large") {
    const MeshSource mesh = boxes();
    for (const double azimuth : {0.0, 33.0, 150.0, 271.0})
      for (const double elevation : {-20.0, 5.0, 40.0, 89.0}) {
        CAPTURE(azimuth);
        CAPTURE(elevation);
        const detail::Camera camera = detail::camera_at(azimuth, elevation);
        const auto placing = detail::placing_in(mesh, camera, {0, 0, 600, 400});
        const auto faces = detail::faces_of(mesh, camera, placing);
        const auto pixels = detail::seen_pixels(faces, 600, 400);
        const auto rings = detail::visible_rings(faces);
        double all = 0, differ = 0;
        for (std::size_t i = 0; i < faces.size(); ++i) {
          all += pixels[i];
          differ += std::abs(pixels[i] - detail::area_px(rings[i]));
        }
        CHECK(all > 20'000);
        CHECK(differ < 0.01 * all);
      }
  }

  TEST_CASE("the nearer face of two is seen and of two in one plane the part") {
    MeshSource mesh;
    add_box(mesh, {0, 0, 0}, {4, 4, 4}, "wall");
    add_box(mesh, {1, -2, 1}, {3, -1, 3}, "garage");  // before it
    add_box(mesh, {0, 5, 0}, {4, 6, 4}, "door");      // behind it
    const detail::Camera camera = detail::camera_at(180, 0);
    const auto faces =
        detail::faces_of(mesh, camera, detail::placing_in(mesh, camera, {0, 0, 100, 100}));
    const auto seen = detail::seen_pixels(faces, 100, 100);
    std::map<int, double> of_feature;
    for (std::size_t i = 0; i < faces.size(); ++i) of_feature[faces[i].feature] += seen[i];
    CHECK(of_feature[1] > 0);
    CHECK(of_feature[0] == doctest::Approx(3 * of_feature[1]).epsilon(0.02));
    CHECK(of_feature[2] == 0);
  }

  TEST_CASE("a picture has the same bytes twice in every format and theme") {
    for (const auto format : {PictureFormat::png, PictureFormat::svg, PictureFormat::pdf})
      for (const bool is_dark : {false, true}) {
        PictureOptions options{.width_px = 300, .height_px = 200, .is_dark = is_dark};
        CHECK(drawn(boxes(), format, options) == drawn(boxes(), format, options));
        CHECK(drawn(boxes(), format, options) !=
              drawn(boxes(), format, {.width_px = 300, .height_px = 200, .is_dark = !is_dark}));
      }
  }

  TEST_CASE("each part that is seen is a group of the SVG with its id and label") {
    const std::string svg = drawn(boxes(), PictureFormat::svg, {.elevation_deg = 45});
    const auto elements = elements_in(svg);
    REQUIRE(!elements.empty());
    CHECK(elements.at("g") == 5);  // four parts, the legend
    for (const char* part :
         {"id=\"b_chimney1\" class=\"chimney\"", "id=\"b_garage3\" class=\"garage\""})
      CHECK(svg.find(part) != std::string::npos);
    CHECK(svg.find("chimney 1") != std::string::npos);
  }

  TEST_CASE("an id stands once in an SVG however many panels show its part") {
    const auto made = picture({{.mesh = boxes()}, {.mesh = boxes()}, {.mesh = boxes()}},
                              PictureFormat::svg, {.elevation_deg = 45});
    REQUIRE(made.value);
    for (const char* id : {"id=\"b_chimney1\"", "id=\"b_chimney1-2\"", "id=\"b_chimney1-3\""}) {
      CAPTURE(id);
      const std::size_t at = made.value->find(id);
      CHECK(at != std::string::npos);
      CHECK(made.value->find(id, at + 1) == std::string::npos);
    }
  }

  TEST_CASE("a mark has the colour of its reason and the legend says which") {
    PicturePanel panel{.mesh = boxes(), .marks = {{{"b", "chimney1"}, PictureMark::missed}}};
    const auto count_of = [&](PictureMark mark, const char* colour) {
      panel.marks.begin()->second = mark;
      const std::string svg = *picture({panel}, PictureFormat::svg, {.elevation_deg = 45}).value;
      CHECK((svg.find(">changed 1<") != std::string::npos) == (mark == PictureMark::changed));
      return occurrences(svg, std::string("stroke=\"") + colour);
    };
    CHECK(count_of(PictureMark::missed, "#0072b2") > 1);
    CHECK(count_of(PictureMark::right, "#009e73") > 1);
    CHECK(count_of(PictureMark::changed, "#d00050") > 1);
    CHECK(count_of(PictureMark::missed, "#d00050") == 0);
    // Pixels of the mark are there as well.
    panel.marks.begin()->second = PictureMark::missed;
    CHECK(*picture({panel}, PictureFormat::png).value != drawn(boxes(), PictureFormat::png, {}));
  }

  TEST_CASE("what is not marked is pale where a panel says so") {
    PicturePanel panel{.mesh = boxes(), .marks = {{{"b", "chimney1"}, PictureMark::explained}}};
    const std::string plain = *picture({panel}, PictureFormat::svg).value;
    panel.fades_others = true;
    const std::string faded = *picture({panel}, PictureFormat::svg).value;
    const auto group = [](const std::string& svg, const std::string& id) {
      const std::size_t from = svg.find("id=\"" + id + "\"");
      return svg.substr(from, svg.find("</g>", from) - from);
    };
    CHECK(group(plain, "b_chimney1") == group(faded, "b_chimney1"));
    CHECK(group(plain, "b_garage3") != group(faded, "b_garage3"));
  }

  TEST_CASE("a caption takes no more lines where its panel makes room for a drawing at map size") {
    const auto lines = [](double map_dpi) {
      const PicturePanel panel{.mesh = boxes(), .caption = "one two three", .map_scale = 500};
      return occurrences(*picture({panel}, PictureFormat::svg,
                                  {.width_px = 160, .has_legend = false, .map_dpi = map_dpi})
                              .value,
                         "<text");
    };
    CHECK(lines(0) == 1);
    CHECK(lines(60) == 1);
  }

  TEST_CASE("backs of a part of a closed body are not seen where a panel says so") {
    PicturePanel panel{.mesh = boxes()};
    panel.mesh.polygons.resize(5);  // of the first box: open, as of a part alone
    const auto shapes = [&] {
      return occurrences(*picture({panel}, PictureFormat::svg, {.has_legend = false}).value,
                         "<path");
    };
    const std::size_t both_sides = shapes();
    panel.hides_backs = true;
    CHECK(shapes() < both_sides);
  }

  TEST_CASE("a PDF has as many pages as its panels take and other formats one picture") {
    std::vector<PicturePanel> panels(5, {.mesh = boxes(), .caption = "house"});
    PictureOptions options{.width_px = 300, .height_px = 200};
    const auto pages = [&] {
      const std::string pdf = *picture(panels, PictureFormat::pdf, options).value;
      return occurrences(pdf, "/Type /Page %");
    };
    CHECK(pages() == 1);
    for (const auto& [of_page, count] :
         {std::pair<std::size_t, std::size_t>(1, 5), {2, 3}, {5, 1}, {9, 1}}) {
      options.panels_of_page = of_page;
      CAPTURE(of_page);
      CHECK(pages() == count);
    }
    options.panels_of_page = 2;
    CHECK(occurrences(*picture(panels, PictureFormat::svg, options).value, ">house<") == 5);
  }

  TEST_CASE("a long caption is broken between words") {
    const PicturePanel panel{.mesh = boxes(), .caption = "one two three four five six\nseven"};
    const std::string svg =
        *picture({panel}, PictureFormat::svg, {.width_px = 150, .has_legend = false}).value;
    CHECK(occurrences(svg, "<text") == 3);
    CHECK(svg.find(">seven<") != std::string::npos);
  }

  TEST_CASE("a picture is the same where the coordinates are those of a country") {
    MeshSource far = boxes();
    for (Vec3& point : far.points) point = point + Vec3{4'500'000, 5'400'000, 512};
    CHECK(drawn(far, PictureFormat::png, {}) == drawn(boxes(), PictureFormat::png, {}));
  }

  TEST_CASE("buildings that lie too far apart are refused in one panel and fit two") {
    MeshSource far = boxes();
    for (Vec3& point : far.points) point = point + Vec3{600'000, 0, 0};
    MeshSource both = boxes();
    add_box(both, {600'000, 0, 0}, {600'010, 8, 6}, "wall");
    const auto refused = picture({{.mesh = both}}, PictureFormat::svg);
    REQUIRE(refused.issues.size() == 1);
    CHECK(refused.issues[0].code == Code::E163);
    CHECK(picture({{.mesh = boxes()}, {.mesh = far}}, PictureFormat::svg).value);
    CHECK(!picture({{.mesh = boxes(), .frame = 1}, {.mesh = far, .frame = 1}}, PictureFormat::svg)
               .value);
  }

  TEST_CASE("what no font has and what is no UTF-8 in a caption costs no picture") {
    for (const auto format : {PictureFormat::png, PictureFormat::svg, PictureFormat::pdf})
      CHECK(picture({{.mesh = boxes(), .caption = "a\xff\x01\u65e5\u202e<b>"}}, format).value);
  }

  TEST_CASE("a facade is looked at straight and one that is not there is an error") {
    MeshSource mesh = boxes();
    const PictureOptions south{.view = PictureView::facade, .azimuth_deg = 200};
    CHECK(picture({{.mesh = mesh}}, PictureFormat::svg, south).value);
    std::erase_if(mesh.polygons, [](const MeshPolygon& polygon) { return polygon.normal.y < 0; });
    const auto made = picture({{.mesh = mesh}}, PictureFormat::svg, south);
    CHECK(!made.value);
    REQUIRE(made.issues.size() == 1);
    CHECK(made.issues[0].code == Code::E170);
  }

  TEST_CASE("a picture of nothing and the least and thinnest picture are pictures") {
    for (const auto format : {PictureFormat::png, PictureFormat::svg, PictureFormat::pdf}) {
      CHECK(picture({}, format).value);
      CHECK(picture({{}}, format).value);
      CHECK(!drawn(boxes(), format, {.width_px = kLeastPicture_px, .height_px = kLeastPicture_px})
                 .empty());
      CHECK(!drawn(boxes(), format, {.width_px = 2000, .height_px = kLeastPicture_px}).empty());
    }
  }

  TEST_CASE("usual labels have their colour and surfaces are no parts") {
    CHECK(colour_of_label("window") == Colour{0x0e, 0x75, 0xbd});
    CHECK(colour_of_label("bay_window") == colour_of_label("bay"));
    CHECK(is_label_of_part("window"));
    for (const char* label :
         {"wall", "roof", "ground", "outerceiling", "outerfloor", "unlabelled", ""})
      CHECK_FALSE(is_label_of_part(label));
  }
}

}  // namespace oriel
