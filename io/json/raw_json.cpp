#include "io/json/raw_json.h"

#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <utility>

namespace oriel {

namespace {

bool is_closing(char c) { return c == '}' || c == ']'; }

}  // namespace

RawNode::RawNode(std::string_view text, std::span<const std::string_view> known)
    : close_(text.front() == '{' ? '}' : ']') {
  std::size_t from = 1;
  std::size_t at = skip_space(text, from);
  inside_ = text.substr(from, at - from);
  while (at < text.size() && !is_closing(text[at])) {
    Slot slot;
    if (close_ == '}') {
      const std::size_t key_end = end_of_value(text, at);
      slot.key = text.substr(at, key_end - at);
      at = skip_space(text, std::min(skip_space(text, key_end) + 1, text.size()));
    }
    slot.before = text.substr(from, at - from);
    const std::size_t value_end = end_of_value(text, at, known);
    slot.value = text.substr(at, value_end - at);
    at = skip_space(text, value_end);
    slot.after = text.substr(value_end, at - value_end);
    slots_.push_back(std::move(slot));
    if (at >= text.size() || text[at] != ',') break;
    from = at + 1;
    at = skip_space(text, from);
  }
}

std::string_view RawNode::value(std::size_t i) const {
  return slots_[i].changed ? std::string_view(*slots_[i].changed) : slots_[i].value;
}

std::string RawNode::key(std::size_t i) const {
  return slots_[i].added_key.empty() ? decoded(slots_[i].key) : slots_[i].added_key;
}

std::optional<std::size_t> RawNode::find(std::string_view key) const {
  const auto has_key = [&](const Slot& slot) {
    if (slot.key.size() < 2) return slot.added_key == key;
    if (slot.key.find('\\') != std::string_view::npos) return decoded(slot.key) == key;
    return slot.key.substr(1, slot.key.size() - 2) == key;
  };
  for (std::size_t i = 0; i < slots_.size(); ++i)
    if (!slots_[i].is_erased && has_key(slots_[i])) return i;
  return std::nullopt;
}

std::string_view RawNode::value_of(std::string_view key) const {
  const auto found = find(key);
  return found ? value(*found) : std::string_view();
}

void RawNode::set(std::size_t i, std::string value) {
  slots_[i].node.reset();
  slots_[i].changed = std::move(value);
}

void RawNode::set(std::size_t i, RawNode value) {
  slots_[i].node = std::make_unique<RawNode>(std::move(value));
}

void RawNode::set(std::string_view key, RawNode value) { set(find(key).value(), std::move(value)); }

void RawNode::set(std::string_view key, std::string value) {
  if (const auto found = find(key))
    set(*found, std::move(value));
  else
    append(key, std::move(value));
}

void RawNode::append(std::string_view key, std::string value) {
  push_back(std::move(value));
  slots_.back().added_key = key;
}

void RawNode::push_back(std::string value) {
  slots_.emplace_back();
  slots_.back().changed = std::move(value);
}

void RawNode::erase(std::string_view key) {
  if (const auto found = find(key)) erase(*found);
}

std::string RawNode::text() const {
  std::string result;
  append_text(result);
  return result;
}

std::size_t RawNode::text_size() const {
  std::size_t size = inside_.size() + 2;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    size += slot.before.size() + slot.added_key.size() + slot.after.size() + 4;
    size += slot.node ? slot.node->text_size() : value(i).size();
  }
  return size;
}

template <class Append>
void RawNode::visit_pieces(const Append& append) const {
  append(close_ == '}' ? "{" : "[");
  bool is_first = true;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const Slot& slot = slots_[i];
    if (slot.is_erased) continue;
    if (!std::exchange(is_first, false)) append(",");
    if (!slot.added_key.empty()) {
      std::string key;
      append_json(key, std::string_view(slot.added_key));
      append(key += ':');
    }
    append(slot.before);
    if (slot.node)
      slot.node->visit_pieces(append);
    else
      append(value(i));
    append(slot.after);
  }
  if (slots_.empty()) append(inside_);
  append(std::string_view(&close_, 1));
}

void RawNode::append_text(std::string& out) const {
  out.reserve(out.size() + text_size());
  visit_pieces([&](std::string_view piece) { out += piece; });
}

void RawNode::write(const std::function<void(std::string_view)>& sink) const {
  visit_pieces([&](std::string_view piece) { sink(piece); });
}

void for_each_element(std::string_view text, const std::function<void(std::string_view)>& visit) {
  std::size_t at = skip_space(text, 1);
  while (at < text.size() && !is_closing(text[at])) {
    const std::size_t end = end_of_value(text, at);
    visit(text.substr(at, end - at));
    at = skip_space(text, end);
    if (at >= text.size() || text[at] != ',') return;
    at = skip_space(text, at + 1);
  }
}

std::vector<std::string_view> elements_of(std::string_view text) {
  std::vector<std::string_view> elements;
  if (RawNode::is_array(text))
    for_each_element(text, [&](std::string_view value) { elements.push_back(value); });
  return elements;
}

}  // namespace oriel
