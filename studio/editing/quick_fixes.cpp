#include "studio/editing/quick_fixes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

bool is_part_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// The text in single quotes after `words` in the sentence; nothing if it does not say so.
std::optional<std::string> quoted_after(std::string_view sentence, std::string_view words) {
  const std::size_t at = sentence.find(words);
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t begin = at + words.size();
  if (begin >= sentence.size() || sentence[begin] != '\'') return std::nullopt;
  const std::size_t end = sentence.find('\'', begin + 1);
  if (end == std::string_view::npos || end == begin + 1) return std::nullopt;
  return std::string(sentence.substr(begin + 1, end - begin - 1));
}

/// The same up to the last quote, of texts that have quotes themselves.
std::optional<std::string> all_quoted_after(std::string_view sentence, std::string_view words) {
  const std::size_t at = sentence.find(words);
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t begin = at + words.size();
  const std::size_t end = sentence.rfind('\'');
  if (begin >= sentence.size() || sentence[begin] != '\'' || end <= begin) return std::nullopt;
  return std::string(sentence.substr(begin + 1, end - begin - 1));
}

QuickFix replacement(std::string_view text, TextSpan where, std::string by) {
  const std::string_view old = text.substr(where.begin, where.end - where.begin);
  std::string title = old.empty()  ? fmt::format("insert '{}'", by)
                      : by.empty() ? fmt::format("remove '{}'", old)
                                   : fmt::format("replace '{}' by '{}'", old, by);
  return {std::move(title), {{where, std::move(by)}}};
}

/// Where `name` stands as a whole word in `span`; nothing if it does not, or more than once.
std::optional<TextSpan> find_name(std::string_view text, SourceSpan span, std::string_view name) {
  if (name.empty()) return std::nullopt;
  std::optional<TextSpan> found;
  for (std::size_t at = text.find(name, span.begin);
       at != std::string_view::npos && at + name.size() <= span.end; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool is_whole =
        (at == 0 || !is_part_of_name(text[at - 1]) || !is_part_of_name(name[0])) &&
        (end >= text.size() || !is_part_of_name(text[end]) || !is_part_of_name(name.back()));
    if (!is_whole) continue;
    if (found) return std::nullopt;
    found = TextSpan{at, end};
  }
  return found;
}

/// "unknown class 'openning'; did you mean 'opening'?", "there is no attribute 'slope'; oriel calls
/// it 'inclination'".
std::optional<QuickFix> other_name(std::string_view text, const SpannedFinding& finding) {
  const std::string_view sentence = finding.sentence;
  auto meant = quoted_after(sentence, "did you mean ");
  if (!meant) meant = quoted_after(sentence, "oriel calls it ");
  const bool is_param = sentence.find("did you mean the param ") != std::string_view::npos;
  if (!meant && is_param) meant = quoted_after(sentence, "did you mean the param ");
  // "did you mean 'range: lo .. hi'?" is a form, and no word to put there.
  if (!meant || meant->find("..") != std::string::npos) return std::nullopt;
  for (const std::string_view before : {"unknown attribute or relation ",
                                        "unknown attribute ",
                                        "unknown surface attribute ",
                                        "unknown class ",
                                        "unknown param ",
                                        "unknown relation ",
                                        "unknown operator ",
                                        "unknown macro ",
                                        "unknown group ",
                                        "unknown unit ",
                                        "unknown function ",
                                        "unknown word ",
                                        "unknown key ",
                                        "there is no attribute ",
                                        "there is no relation ",
                                        "there is no operator ",
                                        "there is no unit ",
                                        "there is no function ",
                                        "there is no fixture ",
                                        "there is no pack ",
                                        "the pack has no ",
                                        ", not ",
                                        " is never "}) {
    const auto name = quoted_after(sentence, before);
    const auto where = name ? find_name(text, finding.where, *name) : std::nullopt;
    if (where) return replacement(text, *where, *meant);
  }
  return std::nullopt;
}

/// "'&&': write 'and'", "'width_max' is a param; write '$width_max'".
std::optional<QuickFix> other_form(std::string_view text, const SpannedFinding& finding) {
  const std::string_view here =
      text.substr(finding.where.begin, finding.where.end - finding.where.begin);
  const std::string_view sentence = finding.sentence;
  if (here.empty() || !sentence.starts_with(fmt::format("'{}'", here))) return std::nullopt;
  const std::string_view rest = sentence.substr(here.size() + 2);
  auto form = quoted_after(rest, ": write ");
  if (!form) form = quoted_after(rest, "; write ");
  if (!form || form->find("...") != std::string::npos) return std::nullopt;
  TextSpan where{finding.where.begin, finding.where.end};
  const bool is_class_test = finding.code == Code::R205 && rest.starts_with(" is");
  if (finding.code == Code::R205 && !is_class_test) return std::nullopt;
  if (finding.code == Code::R207) return std::nullopt;
  if (!is_class_test) return replacement(text, where, *form);
  // `self is wall` becomes `host is wall`: the words before the name belong to the form.
  std::string_view before = text.substr(0, where.begin);
  for (const std::string_view word : {"is", "self", "other"}) {
    const std::size_t end = before.find_last_not_of(' ');
    if (end == std::string_view::npos) break;
    const std::string_view left = before.substr(0, end + 1);
    const bool is_word =
        left.ends_with(word) &&
        (left.size() == word.size() || !is_part_of_name(left[left.size() - word.size() - 1]));
    if (!is_word) continue;
    before = left.substr(0, left.size() - word.size());
    where.begin = before.size();
  }
  return replacement(text, where, *form);
}

/// "'width' is an attribute and not a param; write it without '$'".
std::optional<QuickFix> without_dollar(std::string_view text, const SpannedFinding& finding) {
  const std::size_t at = finding.where.begin;
  const bool is_meant = finding.sentence.ends_with("write it without '$'");
  if (!is_meant || at >= text.size() || text[at] != '$') return std::nullopt;
  return replacement(text, {at, at + 1}, "");
}

/// "decimals are written with a point: 1.5".
std::optional<QuickFix> decimal_point(std::string_view text, const SpannedFinding& finding) {
  const bool is_meant =
      finding.sentence.find("decimals are written with a point") != std::string::npos;
  if (!is_meant || finding.where.end >= text.size()) return std::nullopt;
  const std::size_t next = text.find_first_not_of(' ', finding.where.end);
  if (next == std::string_view::npos) return std::nullopt;
  return replacement(text, {finding.where.begin, next}, ".");
}

/// "a comma ends no line outside { } and [ ]", "bare 'no' is …; write true, false or "no"".
std::optional<QuickFix> other_scalar(std::string_view text, const SpannedFinding& finding) {
  if (finding.code != Code::R214 && finding.code != Code::R211) return std::nullopt;
  const TextSpan where{finding.where.begin, finding.where.end};
  if (where.begin >= where.end) return std::nullopt;
  const std::string here(text.substr(where.begin, where.end - where.begin));
  if (finding.sentence.starts_with("a comma ends no line") && here.back() == ',')
    return replacement(text, {where.end - 1, where.end}, "");
  const std::string quoted = fmt::format("\"{}\"", here);
  if (!finding.sentence.ends_with("write " + quoted) &&
      finding.sentence.find("or " + quoted) == std::string::npos)
    return std::nullopt;
  const bool is_switch = finding.sentence.find("write true, false or ") != std::string::npos;
  if (!is_switch) return replacement(text, where, quoted);
  const bool is_yes = here == "yes" || here == "on" || here == "Yes" || here == "On" ||
                      here == "YES" || here == "ON" || here == "y" || here == "Y";
  return replacement(text, where, is_yes ? "true" : "false");
}

/// The line of a text that is no YAML, mended: "…; write 'LINE'".
std::optional<QuickFix> mended_line(std::string_view text, const SpannedFinding& finding) {
  if (finding.code != Code::R201) return std::nullopt;
  const auto line = all_quoted_after(finding.sentence, "; write ");
  if (!line || finding.where.begin > text.size()) return std::nullopt;
  const std::size_t at = finding.where.begin;
  std::size_t begin = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
  begin = begin == std::string_view::npos ? 0 : begin + 1;
  std::size_t end = std::min(text.find('\n', at), text.size());
  if (end > begin && text[end - 1] == '\r') --end;
  const std::string_view old = text.substr(begin, end - begin);
  if (line->find('\n') != std::string::npos || old == *line) return std::nullopt;
  return QuickFix{
      fmt::format("write '{}'", line->substr(std::min(line->find_first_not_of(' '), line->size()))),
      {{{begin, end}, *line}}};
}

}  // namespace

std::vector<QuickFix> fixes_of(std::string_view text, const SpannedFinding& finding) {
  using Reader = std::optional<QuickFix> (*)(std::string_view, const SpannedFinding&);
  constexpr std::array<Reader, 6> readers = {other_name,    other_form,   without_dollar,
                                             decimal_point, other_scalar, mended_line};
  for (const Reader read : readers)
    if (auto fix = read(text, finding)) return {std::move(*fix)};
  return {};
}

}  // namespace oriel::rules
