// libyaml: the events of rule packs, in a fraction of yaml-cpp's time.
// Trap: a mark's index counts characters, not bytes.
// Trap: duplicate keys and explicit keys (`? key`) come like others; only the text tells them
// apart.
#include <cstdio>
#include <cstring>
#include <yaml.h>

int main() {
  const char* text = "maße: 1 m\nbreite: 2 m\n";
  yaml_parser_t parser;
  if (yaml_parser_initialize(&parser) == 0) return 1;
  yaml_parser_set_input_string(&parser, reinterpret_cast<const unsigned char*>(text),
                               std::strlen(text));
  bool is_at_character = false;
  for (bool is_done = false; !is_done;) {
    yaml_event_t event;
    if (yaml_parser_parse(&parser, &event) == 0) break;
    is_done = event.type == YAML_STREAM_END_EVENT;
    if (event.type == YAML_SCALAR_EVENT) {
      const char* value = reinterpret_cast<const char*>(event.data.scalar.value);
      std::printf("character %zu: %s\n", event.start_mark.index, value);
      if (std::strcmp(value, "breite") == 0) {
        const auto byte = static_cast<std::size_t>(std::strstr(text, value) - text);
        is_at_character = event.start_mark.index + 1 == byte;
      }
    }
    yaml_event_delete(&event);
  }
  yaml_parser_delete(&parser);
  return is_at_character ? 0 : 1;
}
