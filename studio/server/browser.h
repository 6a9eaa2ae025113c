#pragma once

#include <string>

namespace oriel::studio {

/// Opens the address in the browser of this desktop (xdg-open) and returns at once. False if there
/// is no desktop or no xdg-open.
bool open_browser(const std::string& address);

}  // namespace oriel::studio
