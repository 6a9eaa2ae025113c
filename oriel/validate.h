#pragma once

#include "kernel/validate/validate.h"  // IWYU pragma: export
