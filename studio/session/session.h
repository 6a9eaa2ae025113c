#pragma once

#include "kernel/base/parallel.h"
#include "oriel/label.h"
#include "oriel/read.h"
#include "studio/session/work_log.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel::studio {

/// What a studio is opened with.
struct SessionOptions {
  /// Files of buildings, in their order; buildings are numbered in it.
  std::vector<std::string> files;
  ReadOptions read;
  /// Texts of files by their names, and the folder to which the verb `samples` writes them: what is
  /// offered where there are no files.
  std::vector<std::pair<std::string, std::string_view>> samples;
  std::string samples_folder = "oriel-samples";
  /// What is read after so many corners of polygons is passed over: what is kept of each takes
  /// some 250 bytes, without labels.
  std::size_t most_corners = 12'000'000;
  /// How buildings become features and labels; `corrections` is left aside, and `corrections` below
  /// holds.
  LabelOptions label;
  /// A file, or the name of a pack that is built in.
  std::string rules = "residential";
  /// Files of truth (*.truth.json, *.truth.jsonl); empty: there is none.
  std::vector<std::string> truth;
  /// The file of corrections, which need not exist yet; each correction writes it anew.
  std::string corrections = "corrections.jsonl";
  /// Folders, and those below them, to which `save` may write. The pack's own file always may be
  /// written (is_within).
  std::vector<std::string> folders;
  /// Buildings that are segmented or labelled at the same time; results do not depend on it.
  int jobs = 1;
  ForEachShare for_each = for_each_in_turn;
  /// Hears of what is at work, and knows what ended an earlier worker; null: nobody asks.
  WorkLog* work_log = nullptr;
};

/// What is said to a request: a status of HTTP, and JSON or bytes.
struct Reply {
  int status = 200;
  std::string json;
  /// Of a verb that gives bytes (studio/session/README.md); empty: `json` holds.
  std::string bytes = {};
};

/// `{"error": sentence, "code": code}`, without an empty code.
Reply error_reply(int status, std::string_view sentence, std::string_view code = {});

/// What the studio keeps of buildings, pack, truth and corrections, and what it answers to the
/// page. The verbs, their bodies and answers are in studio/session/README.md.
class Session {
 public:
  /// Begins to read and to segment the files in the background. Throws nothing for what is wrong
  /// with files, pack or truth: `state` says so.
  explicit Session(SessionOptions options);
  /// Ends what runs in the background.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The answer to `POST /api/VERB`. May be called from any thread; a slow verb blocks its own
  /// thread only. `body` may hold anything: what is no JSON object is answered with 400, an unknown
  /// verb with 404. Throws std::bad_alloc only.
  Reply answer(std::string_view verb, std::string_view body);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace oriel::studio
