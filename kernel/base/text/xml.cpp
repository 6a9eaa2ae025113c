#include "kernel/base/text/xml.h"

#include "kernel/base/text/printable.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel {

std::string escaped_xml(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0, bytes = 0; at < text.size(); at += std::max<std::size_t>(bytes, 1)) {
    bytes = utf8_length(text, at);
    const std::string_view here = text.substr(at, bytes);
    if (here == "&")
      out += "&amp;";
    else if (here == "<")
      out += "&lt;";
    else if (here == ">")
      out += "&gt;";
    else if (here == "\"")
      out += "&quot;";
    else if (here == "\t" || here == "\n" || here == "\r")
      out += fmt::format("&#{};", static_cast<int>(here[0]));
    else if (here.empty() || (bytes == 1 && here[0] < ' ') || here == "\xEF\xBF\xBE" ||
             here == "\xEF\xBF\xBF")
      out += "\xEF\xBF\xBD";
    else
      out += here;
  }
  return out;
}

}  // namespace oriel
