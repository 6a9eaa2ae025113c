#pragma once

#include <string>
#include <vector>

namespace oriel::cli {

struct RunOptions;
class Report;

/// Turns the inputs that were given into files: a folder means its files, as files_in() lists them,
/// and what is named several times is read once, where it stands first. Of the latter a warning
/// E602 is reported, of files in folders that are passed over a note. A folder without files stays:
/// refuse_folder() says so when its turn comes.
void settle_inputs(RunOptions& options, Report& report);

/// Drops files that stand there again, also by another spelling or a link, and reports a warning
/// E602 for each.
void read_once(std::vector<std::string>& files, Report& report);

/// The files of buildings in a folder, sorted by name; not those in folders within it. With `from`,
/// a name of a format, those of this format. Plain .json and .jsonl files count if they hold
/// CityJSON: records, truths and reports have these extensions, too.
std::vector<std::string> files_in(const std::string& folder, const std::string& from);

/// The files of truth that are named; a folder means its *.truth.json and *.truth.jsonl, sorted by
/// name. Throws InputError E101 for a folder without any.
std::vector<std::string> truth_files(const std::vector<std::string>& named);

/// Throws InputError E106 if the input is a folder, which then has no file to read.
void refuse_folder(const std::string& input);

}  // namespace oriel::cli
