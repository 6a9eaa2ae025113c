#include "io/picture/cairo_library.h"

#include <dlfcn.h>
#include <optional>

namespace oriel::detail {

/// "libcairo.so.2".
extern const char* const kCairoName;

namespace {

std::optional<CairoLibrary> open_cairo() {
  void* library = ::dlopen(kCairoName, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return std::nullopt;
  CairoLibrary cairo;
#define ORIEL_CAIRO_LOOK_UP(name)                                               \
  cairo.name = reinterpret_cast<decltype(cairo.name)>(::dlsym(library, #name)); \
  if (cairo.name == nullptr) return std::nullopt;
  ORIEL_CAIRO_FUNCTIONS(ORIEL_CAIRO_LOOK_UP)
#undef ORIEL_CAIRO_LOOK_UP
  return cairo;
}

}  // namespace

const CairoLibrary* cairo_library() {
  static const std::optional<CairoLibrary> cairo = open_cairo();
  return cairo ? &*cairo : nullptr;
}

}  // namespace oriel::detail
