#include "tests/support/error_files.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace oriel::test {

namespace {

/// In millimetres.
using Point = std::array<int, 3>;
using Ring = std::vector<Point>;
using Face = std::vector<Ring>;
using Shell = std::vector<Face>;
using Body = std::vector<Shell>;

/// The faces of a box: bottom, top, south, east, north, west.
Shell box(Point a, Point b) {
  const auto p = [&](int x, int y, int z) {
    return Point{x != 0 ? b[0] : a[0], y != 0 ? b[1] : a[1], z != 0 ? b[2] : a[2]};
  };
  return {{{p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0)}},
          {{p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)}},
          {{p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)}},
          {{p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1)}},
          {{p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(1, 1, 1)}},
          {{p(0, 1, 0), p(0, 0, 0), p(0, 0, 1), p(0, 1, 1)}}};
}

Shell cube() { return box({0, 0, 0}, {4000, 4000, 4000}); }

/// The cube with another top.
Shell cube_under(Face top) {
  Shell shell = cube();
  shell[1] = std::move(top);
  return shell;
}

const Ring kTop{{0, 0, 4000}, {4000, 0, 4000}, {4000, 4000, 4000}, {0, 4000, 4000}};

/// A square hole in the top, running clockwise seen from above.
Ring hole(int x0, int y0, int x1, int y1) {
  return {{x0, y0, 4000}, {x0, y1, 4000}, {x1, y1, 4000}, {x1, y0, 4000}};
}

Shell turned(Shell shell) {
  for (Face& face : shell)
    for (Ring& ring : face) std::ranges::reverse(ring);
  return shell;
}

Shell joined(Shell p, const Shell& q) {
  p.insert(p.end(), q.begin(), q.end());
  return p;
}

Shell cavity(Point a, Point b) { return turned(box(a, b)); }

/// The cube, its top a pyramid upside down whose apex comes out below the bottom.
Shell pierced_cube() {
  Shell shell = cube();
  shell.erase(shell.begin() + 1);
  const Point apex{2000, 2000, -1000};
  for (std::size_t i = 0; i < 4; ++i) shell.push_back({{kTop[i], kTop[(i + 1) % 4], apex}});
  return shell;
}

/// Five triangles in a ring, each turned against the next: a band with one side.
Shell one_sided_band() {
  const std::array<Point, 5> p{Point{0, 0, 0}, Point{4000, 0, 500}, Point{1000, 4000, 3000},
                               Point{3500, 3000, -2000}, Point{500, 1500, 6000}};
  Shell shell;
  for (std::size_t i = 0; i < 5; ++i) shell.push_back({{p[i], p[(i + 1) % 5], p[(i + 2) % 5]}});
  return shell;
}

/// Two pyramids base to base. With its base across the whole cube it parts the rest in two.
Shell double_pyramid() {
  const Ring base{{0, 0, 2000}, {4000, 0, 2000}, {4000, 4000, 2000}, {0, 4000, 2000}};
  Shell shell;
  for (std::size_t i = 0; i < 4; ++i) {
    shell.push_back({{base[i], base[(i + 1) % 4], {2000, 2000, 3000}}});
    shell.push_back({{base[(i + 1) % 4], base[i], {2000, 2000, 1000}}});
  }
  return shell;
}

/// A top whose middle rises by 5 mm over 2 mm, and the sides that fit it.
Shell folded_cube() {
  Shell shell = cube();
  for (Face& face : shell)
    for (Point& p : face[0])
      if (p[0] == 4000 && p[2] == 4000) p[2] = 4005;
  const auto step = [](int x, int y) { return Point{x, y, x > 2000 ? 4005 : 4000}; };
  shell[1] = {{{0, 0, 4000},
               step(2000, 0),
               step(2002, 0),
               {4000, 0, 4005},
               {4000, 4000, 4005},
               step(2002, 4000),
               step(2000, 4000),
               {0, 4000, 4000}}};
  shell[2][0].insert(shell[2][0].begin() + 3, {step(2002, 0), step(2000, 0)});
  shell[4][0].insert(shell[4][0].begin() + 3, {step(2000, 4000), step(2002, 4000)});
  return shell;
}

Shell cube_with_raised_corner() {
  Shell shell = cube();
  for (Face& face : shell)
    for (Point& p : face[0])
      if (p == Point{4000, 4000, 4000}) p[2] = 4500;
  return shell;
}

/// Writes one building; vertices are numbered by their first use.
class CityJson {
 public:
  std::string text(const std::string& type, const std::vector<Body>& bodies) {
    std::string boundaries = list(bodies, [&](const Body& body) {
      return list(body, [&](const Shell& shell) {
        return list(shell, [&](const Face& face) {
          return list(face, [&](const Ring& ring) {
            return list(ring, [&](const Point& point) { return std::to_string(number(point)); });
          });
        });
      });
    });
    // One solid, and surfaces, are nested less deep than several solids.
    const int outer = type == "Solid" ? 1 : type.ends_with("Surface") ? 2 : 0;
    const auto depth = static_cast<std::size_t>(outer);
    boundaries = boundaries.substr(depth, boundaries.size() - 2 * depth);
    return fmt::format(
        "{{\"type\":\"CityJSON\",\"version\":\"2.0\",\n"
        "\"transform\":{{\"scale\":[0.001,0.001,0.001],\"translate\":[0,0,0]}},\n"
        "\"CityObjects\":{{\"cube\":{{\"type\":\"Building\",\"geometry\":[\n"
        "{{\"type\":\"{}\",\"lod\":\"2\",\"boundaries\":\n{}}}]}}}},\n\"vertices\":[{}]}}\n",
        type, boundaries, vertices_);
  }

 private:
  template <class List, class Write>
  static std::string list(const List& items, const Write& write) {
    std::string text = "[";
    for (const auto& item : items) {
      if (text.size() > 1) text += ',';
      text += write(item);
    }
    text += ']';
    return text;
  }

  int number(const Point& point) {
    const auto [found, is_new] = numbers_.try_emplace(point, static_cast<int>(numbers_.size()));
    if (is_new)
      vertices_ +=
          fmt::format("{}[{},{},{}]", vertices_.empty() ? "" : ",", point[0], point[1], point[2]);
    return found->second;
  }

  std::map<Point, int> numbers_;
  std::string vertices_;
};

ErrorFile solid(const std::string& name, Body body) {
  return {name + ".city.json", CityJson().text("Solid", {std::move(body)})};
}

ErrorFile solids(const std::string& name, const std::vector<Body>& bodies) {
  return {name + ".city.json", CityJson().text("CompositeSolid", bodies)};
}

std::string replaced_once(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// The cube in CityGML, the ring of its top without the last point.
std::string open_ring_gml() {
  std::string members;
  for (const Face& face : cube()) {
    Ring ring = face[0];
    if (ring != kTop) ring.push_back(ring.front());
    std::string positions;
    for (const Point& p : ring)
      positions += fmt::format("{}{} {} {}", positions.empty() ? "" : " ", p[0] / 1000, p[1] / 1000,
                               p[2] / 1000);
    members += fmt::format(
        "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>{}"
        "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>\n",
        positions);
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<CityModel xmlns=\"http://www.opengis.net/citygml/2.0\" "
         "xmlns:bldg=\"http://www.opengis.net/citygml/building/2.0\" "
         "xmlns:gml=\"http://www.opengis.net/gml\"><cityObjectMember>"
         "<bldg:Building gml:id=\"cube\"><bldg:lod2Solid><gml:Solid><gml:exterior>"
         "<gml:CompositeSurface>\n" +
         members +
         "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid></bldg:Building>"
         "</cityObjectMember></CityModel>\n";
}

void add_rings(std::vector<ErrorFile>& files) {
  files.push_back(solid("E311_101", {cube_under({{kTop[0], kTop[1]}})}));
  files.push_back(solid("E312_102", {cube_under({{kTop[0], kTop[1], kTop[1], kTop[2], kTop[3]}})}));
  files.push_back({"E314_103.gml", open_ring_gml()});
  files.push_back(solid("E341_104", {cube_under({{kTop[0], kTop[1], kTop[3], kTop[2]}})}));
}

void add_polygons(std::vector<ErrorFile>& files) {
  const Ring middle = hole(1000, 1000, 3000, 3000);
  files.push_back(solid("E342_201", {cube_under({kTop, hole(3000, 1000, 5000, 3000)})}));
  files.push_back(solid("E343_202", {cube_under({kTop, middle, middle})}));
  files.push_back(solid("E344_203", {cube_with_raised_corner()}));
  files.push_back(solid("E345_204", {folded_cube()}));
  files.push_back(solid(
      "E346_205",
      {cube_under(
          {kTop, {{2000, 0, 4000}, {1000, 2000, 4000}, {2000, 4000, 4000}, {3000, 2000, 4000}}})}));
  files.push_back(solid("E347_206", {cube_under({kTop, hole(5000, 1000, 6000, 3000)})}));
  files.push_back(solid("E348_207", {cube_under({kTop, middle, hole(1500, 1500, 2500, 2500)})}));
  files.push_back(solid("E349_208", {cube_under({kTop, Ring(middle.rbegin(), middle.rend())})}));
}

void add_shells(std::vector<ErrorFile>& files) {
  const Shell whole = cube();
  files.push_back(solid("E301_301", {{whole[0], whole[1], whole[2]}}));
  Shell open = whole;
  open.erase(open.begin() + 1);
  files.push_back(solid("E302_302", {open}));
  files.push_back(solid("E303_303", {joined(whole, box({4000, 4000, 0}, {8000, 8000, 4000}))}));
  files.push_back(solid("E350_303", {joined(whole, box({4000, 4000, 4000}, {8000, 8000, 8000}))}));
  files.push_back(solid("E351_305", {joined(whole, box({9000, 0, 0}, {12000, 3000, 3000}))}));
  files.push_back(solid("E352_306", {pierced_cube()}));
  files.push_back(solid("E308_307", {cube_under({Ring(kTop.rbegin(), kTop.rend())})}));
  files.push_back(solid("E307_307", {one_sided_band()}));
}

void add_solids(std::vector<ErrorFile>& files) {
  const Shell inner = cavity({1000, 1000, 1000}, {3000, 3000, 3000});
  files.push_back(solid("E353_401", {cube(), cavity({1000, 1000, 1000}, {3000, 3000, 5000})}));
  files.push_back(solid("E354_402", {cube(), inner, inner}));
  files.push_back(solid("E305_403", {cube(), cavity({5000, 1000, 1000}, {7000, 3000, 3000})}));
  files.push_back(solid("E355_404", {cube(), turned(double_pyramid())}));
  files.push_back(solid("E308_405", {turned(cube())}));
  const Body one{cube()};
  files.push_back(solids("E356_501", {one, {box({2000, 1000, 1000}, {6000, 3000, 3000})}}));
  files.push_back(solids("E357_502", {one, one}));
  files.push_back(solids("E358_503", {one, {box({6000, 0, 0}, {8000, 2000, 2000})}}));
}

void add_models(std::vector<ErrorFile>& files) {
  const std::string good = solid("", {cube()}).text;
  files.push_back(solid("E313_902", {{}}));
  files.push_back({"E201_000.city.json",
                   replaced_once(good,
                                 "\"transform\":{\"scale\":[0.001,0.001,0.001],\"translate\":[0,0,"
                                 "0]},\n",
                                 "")});
  files.push_back({"E203_000.city.json", replaced_once(good, "[[[[0,", "[[[[8,")});
  files.push_back({"E204_000.city.json", replaced_once(good, "\"Solid\"", "\"Blob\"")});
}

}  // namespace

std::vector<ErrorFile> error_files() {
  std::vector<ErrorFile> files;
  add_rings(files);
  add_polygons(files);
  add_shells(files);
  add_solids(files);
  add_models(files);
  files.push_back(solid("valid", {cube(), cavity({1000, 1000, 1000}, {3000, 3000, 3000})}));
  return files;
}

}  // namespace oriel::test
