#pragma once

#include <memory>
#include <proj.h>

namespace oriel::detail {

struct PjDeleter {
  void operator()(PJ* pj) const { proj_destroy(pj); }
};
struct PjContextDeleter {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
/// Objects of the library PROJ that end with their owner.
using PjPointer = std::unique_ptr<PJ, PjDeleter>;
using PjContextPointer = std::unique_ptr<PJ_CONTEXT, PjContextDeleter>;

}  // namespace oriel::detail
