#include "io/picture/drawing.h"
#include "kernel/base/text/xml.h"

#include <iterator>
#include <map>
#include <string>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

std::string hex(Colour colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

/// A hundredth of a pixel, without a sign of zero.
std::string number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

void append_path(std::string& out, const PictureShape& shape) {
  out += "<path d=\"";
  for (const PictureRing& ring : shape.rings) {
    char command = 'M';
    for (const PicturePoint p : ring) {
      out += command + number(p.x) + ' ' + number(p.y);
      command = 'L';
    }
    out += 'Z';
  }
  out +=
      fmt::format("\" fill=\"{}\" fill-rule=\"evenodd\"", shape.fill ? hex(*shape.fill) : "none");
  if (shape.line)
    out += fmt::format(" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
                       hex(*shape.line), number(shape.line_px));
  out += "/>\n";
}

void append_text(std::string& out, const PictureText& text) {
  fmt::format_to(std::back_inserter(out),
                 "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\" "
                 "font-family=\"DejaVu Sans, sans-serif\">{}</text>\n",
                 number(text.at.x), number(text.at.y), number(text.size_px),
                 text.anchor == TextAnchor::middle ? "middle" : "start", hex(text.colour),
                 escaped_xml(text.text));
}

/// Returns an id that no group had before: an id stands once in a file.
std::string unique_id(const std::string& id, std::map<std::string, int>& taken) {
  const int count = ++taken[id];
  if (count == 1) return id;
  return unique_id(fmt::format("{}-{}", id, count), taken);
}

}  // namespace

std::string svg_of(const PictureDrawing& drawing) {
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\">\n",
      drawing.width_px, drawing.height_px);
  if (drawing.ground)
    fmt::format_to(std::back_inserter(out), "<rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n",
                   hex(*drawing.ground));
  std::map<std::string, int> taken;
  for (const PictureGroup& group : drawing.groups) {
    out += "<g";
    if (!group.id.empty())
      out += fmt::format(" id=\"{}\"", escaped_xml(unique_id(group.id, taken)));
    if (!group.label.empty())
      out += fmt::format(" class=\"{0}\" inkscape:label=\"{0}\"", escaped_xml(group.label));
    out += ">\n";
    if (!group.label.empty())
      out +=
          fmt::format("<title>{}</title>\n",
                      escaped_xml(group.id.empty() ? group.label : group.label + " " + group.id));
    for (const PictureShape& shape : group.shapes) append_path(out, shape);
    for (const PictureText& text : group.texts) append_text(out, text);
    out += "</g>\n";
  }
  return out + "</svg>\n";
}

}  // namespace oriel::detail
