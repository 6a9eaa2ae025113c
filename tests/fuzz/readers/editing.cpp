#include "studio/editing/edited_pack.h"
#include "tests/fuzz/targets.h"

#include <string>

namespace oriel::fuzz {

namespace {

void check_span(const EditedPack& pack, TextSpan span, const char* promised) {
  promise(span.begin <= span.end && span.end <= pack.text().size(), promised);
}

void check_at(const EditedPack& pack, std::size_t offset) {
  for (const Completion& completion : pack.complete(offset)) {
    check_span(pack, completion.replaced, "a completion replaces a piece of the text");
    promise(completion.replaced.end == offset, "a completion ends at its place", completion.label);
  }
  if (const auto hover = pack.hover(offset))
    check_span(pack, hover->where, "a hover is about a piece of the text");
  (void)pack.definition(offset);
  if (!pack.renameable(offset)) return;
  const Renaming renaming = pack.rename(offset, "a_name_that_is_new");
  for (const FileEdits& file : renaming.files)
    for (const TextEdit& edit : file.edits)
      check_span(pack, edit.where, "renaming changes pieces of the text");
}

}  // namespace

/// A text that is being written: the first byte says where somebody is writing.
void editing(std::string_view bytes) {
  if (bytes.empty()) return;
  const auto where = static_cast<unsigned char>(bytes.front());
  const EditedPack pack(std::string(bytes.substr(1)), "a.yaml");
  for (const TextFinding& finding : pack.findings()) {
    check_span(pack, finding.where, "a finding is about a piece of the text");
    for (const QuickFix& fix : finding.fixes)
      for (const TextEdit& edit : fix.edits)
        check_span(pack, edit.where, "a fix changes pieces of the text");
  }
  for (const OutlineItem& item : pack.outline())
    check_span(pack, item.where, "the outline is of pieces of the text");
  check_at(pack, pack.text().size() * where / 255);
  check_at(pack, pack.text().size());
}

}  // namespace oriel::fuzz
