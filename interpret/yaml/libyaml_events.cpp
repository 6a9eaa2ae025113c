#include "interpret/yaml/libyaml_events.h"

#include <algorithm>
#include <string>
#include <vector>
#include <yaml.h>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

namespace oriel::rules {

namespace {

/// Keys that are longer mean something else to yaml-cpp.
constexpr std::size_t kLongestKey = 512;

/// Tabs, line ends of other systems and what cannot be printed.
bool is_unusual(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\n') || byte == 0x7F;
}

bool is_null(std::string_view plain) {
  return plain.empty() || plain == "~" || plain == "null" || plain == "Null" || plain == "NULL";
}

YAML::EmitterStyle::value style_of(bool is_flow) {
  return is_flow ? YAML::EmitterStyle::Flow : YAML::EmitterStyle::Block;
}

/// libyaml counts characters: where each begins in a text that is not all ASCII.
class Offsets {
 public:
  explicit Offsets(std::string_view text) {
    if (std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; }))
      return;
    for (std::size_t i = 0; i < text.size(); ++i)
      if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) begins_.push_back(i);
    begins_.push_back(text.size());
  }
  [[nodiscard]] std::size_t of(const yaml_mark_t& mark) const {
    return begins_.empty() ? mark.index : begins_[std::min(mark.index, begins_.size() - 1)];
  }

 private:
  std::vector<std::size_t> begins_;
};

/// An event of libyaml, freed at the end.
class Event {
 public:
  explicit Event(yaml_parser_t& parser) : is_good_(yaml_parser_parse(&parser, &event_) != 0) {}
  ~Event() {
    if (is_good_) yaml_event_delete(&event_);
  }
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;
  [[nodiscard]] bool is_good() const { return is_good_; }
  [[nodiscard]] const yaml_event_t& operator*() const { return event_; }

 private:
  yaml_event_t event_{};
  bool is_good_;
};

class Translator {
 public:
  Translator(std::string_view text, YAML::EventHandler& events)
      : text_(text), offsets_(text), events_(events) {
    is_ready_ = yaml_parser_initialize(&parser_) != 0;
    if (!is_ready_) return;
    yaml_parser_set_encoding(&parser_, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()),
                                 text.size());
  }
  ~Translator() {
    if (is_ready_) yaml_parser_delete(&parser_);
  }
  Translator(const Translator&) = delete;
  Translator& operator=(const Translator&) = delete;

  /// False where something is not usual.
  bool run() {
    while (is_ready_) {
      const Event event(parser_);
      if (!event.is_good() || !tell(*event)) return false;
      if ((*event).type == YAML_STREAM_END_EVENT) return has_document_;
    }
    return false;
  }

 private:
  /// A map or list that is open.
  struct Open {
    bool is_map;
    bool is_in_brackets;
    bool is_key_next;
  };

  static YAML::Mark mark(std::size_t at) {
    YAML::Mark mark;
    mark.pos = static_cast<int>(at);
    return mark;
  }

  bool tell(const yaml_event_t& event);
  bool tell_document(const yaml_event_t& event);
  bool tell_scalar(const yaml_event_t& event);
  bool tell_list(const yaml_event_t& event);
  bool tell_map(const yaml_event_t& event);
  /// What begins here is a value or an item, not a key.
  bool begin_value() {
    if (open_.empty()) return true;
    const bool is_key = open_.back().is_map && open_.back().is_key_next;
    open_.back().is_key_next = true;
    return !is_key;
  }
  /// The only thing between it and the colon behind it are blanks.
  [[nodiscard]] bool is_before_colon(std::size_t end) const {
    const std::size_t next = text_.find_first_not_of(' ', end);
    return next < text_.size() && text_[next] == ':';
  }

  std::string_view text_;
  Offsets offsets_;
  YAML::EventHandler& events_;
  yaml_parser_t parser_{};
  bool is_ready_ = false;
  bool has_document_ = false;
  std::vector<Open> open_;
};

bool Translator::tell(const yaml_event_t& event) {
  switch (event.type) {
    case YAML_STREAM_START_EVENT:
    case YAML_STREAM_END_EVENT:
      return true;
    case YAML_DOCUMENT_START_EVENT:
      return tell_document(event);
    case YAML_DOCUMENT_END_EVENT:
      events_.OnDocumentEnd();
      return event.data.document_end.implicit != 0;
    case YAML_SCALAR_EVENT:
      return tell_scalar(event);
    case YAML_SEQUENCE_START_EVENT:
      return tell_list(event);
    case YAML_SEQUENCE_END_EVENT:
      open_.pop_back();
      events_.OnSequenceEnd();
      return true;
    case YAML_MAPPING_START_EVENT:
      return tell_map(event);
    case YAML_MAPPING_END_EVENT:
      open_.pop_back();
      events_.OnMapEnd();
      return true;
    default:
      return false;
  }
}

bool Translator::tell_document(const yaml_event_t& event) {
  const auto& document = event.data.document_start;
  if (has_document_ || document.implicit == 0 || document.version_directive != nullptr ||
      document.tag_directives.start != document.tag_directives.end)
    return false;
  has_document_ = true;
  events_.OnDocumentStart(mark(offsets_.of(event.start_mark)));
  return true;
}

bool Translator::tell_scalar(const yaml_event_t& event) {
  const auto& scalar = event.data.scalar;
  const bool is_plain = scalar.style == YAML_PLAIN_SCALAR_STYLE;
  if (scalar.anchor != nullptr || scalar.tag != nullptr || open_.empty() ||
      (!is_plain && scalar.style != YAML_SINGLE_QUOTED_SCALAR_STYLE &&
       scalar.style != YAML_DOUBLE_QUOTED_SCALAR_STYLE))
    return false;
  std::string value(reinterpret_cast<const char*>(scalar.value), scalar.length);
  const std::size_t begin = offsets_.of(event.start_mark), end = offsets_.of(event.end_mark);
  const std::size_t quote = is_plain ? 0 : 1;
  // As it stands in the text: on one line, without escapes.
  if (text_.substr(begin + quote, value.size()) != value ||
      end != begin + value.size() + 2 * quote || value.find('\n') != std::string::npos ||
      (is_plain && is_null(value)))
    return false;
  Open& parent = open_.back();
  // In brackets a question mark ends what yaml-cpp takes for a plain scalar.
  if (is_plain && parent.is_in_brackets && value.find('?') != std::string::npos) return false;
  if (parent.is_map && parent.is_key_next && (value.size() > kLongestKey || !is_before_colon(end)))
    return false;
  parent.is_key_next = !parent.is_key_next;
  events_.OnScalar(mark(begin), is_plain ? "?" : "!", 0, value);
  return true;
}

bool Translator::tell_list(const yaml_event_t& event) {
  const auto& list = event.data.sequence_start;
  if (list.anchor != nullptr || list.tag != nullptr || open_.empty() || !begin_value())
    return false;
  const bool is_flow = list.style == YAML_FLOW_SEQUENCE_STYLE;
  open_.push_back({false, is_flow, false});
  events_.OnSequenceStart(mark(offsets_.of(event.start_mark)), "?", 0, style_of(is_flow));
  return true;
}

bool Translator::tell_map(const yaml_event_t& event) {
  const auto& map = event.data.mapping_start;
  const std::size_t begin = offsets_.of(event.start_mark);
  const bool is_flow = map.style == YAML_FLOW_MAPPING_STYLE;
  if (map.anchor != nullptr || map.tag != nullptr || !begin_value() ||
      (is_flow && text_[begin] != '{'))
    return false;
  open_.push_back({true, is_flow, true});
  events_.OnMapStart(mark(begin), "?", 0, style_of(is_flow));
  return true;
}

}  // namespace

bool read_by_libyaml(std::string_view text, YAML::EventHandler& events) {
  // A byte order mark, of whatever encoding, begins with no ASCII.
  if (text.empty() || static_cast<unsigned char>(text[0]) >= 0x80 ||
      std::ranges::any_of(text, is_unusual))
    return false;
  return Translator(text, events).run();
}

}  // namespace oriel::rules
