#pragma once

#include "kernel/base/issue.h"
#include "model/correction.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// Reads a file of corrections (`corrections.jsonl`), a JSON object a line; empty lines are passed
/// over. The member "class" is the label, "unknown" an empty one. A line that is no correction is
/// left out and named: E152, or E103 to E105, E503, E504 if it is not JSON. Throws InputError E101
/// if the file cannot be read.
Checked<std::vector<Correction>> read_corrections(const std::string& path);
/// The same of the text of a file that was read before.
Checked<std::vector<Correction>> corrections_in(std::string_view text, const std::string& path);

/// The file that read_corrections() reads as these, line by line; places are left aside.
std::string corrections_text(std::span<const Correction> corrections);

}  // namespace oriel
