#include "io/citygml/citygml_stream.h"

#include <algorithm>
#include <array>
#include <deque>
#include <expat.h>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// The character of each byte of an encoding, as Unicode numbers it; -1 for a byte that has none.
using ByteTable = std::array<int, 256>;

/// A byte and its character.
using ByteCharacter = std::pair<unsigned char, int>;

/// Microsoft's code page 1252 where it differs from ISO-8859-1: 0x80 to 0x9F, five of them unused.
constexpr std::array<ByteCharacter, 32> kWindows1252{
    {{0x80, 0x20AC}, {0x81, -1},     {0x82, 0x201A}, {0x83, 0x0192}, {0x84, 0x201E}, {0x85, 0x2026},
     {0x86, 0x2020}, {0x87, 0x2021}, {0x88, 0x02C6}, {0x89, 0x2030}, {0x8A, 0x0160}, {0x8B, 0x2039},
     {0x8C, 0x0152}, {0x8D, -1},     {0x8E, 0x017D}, {0x8F, -1},     {0x90, -1},     {0x91, 0x2018},
     {0x92, 0x2019}, {0x93, 0x201C}, {0x94, 0x201D}, {0x95, 0x2022}, {0x96, 0x2013}, {0x97, 0x2014},
     {0x98, 0x02DC}, {0x99, 0x2122}, {0x9A, 0x0161}, {0x9B, 0x203A}, {0x9C, 0x0153}, {0x9D, -1},
     {0x9E, 0x017E}, {0x9F, 0x0178}}};

/// ISO-8859-15 where it differs from ISO-8859-1.
constexpr std::array<ByteCharacter, 8> kLatin9{{{0xA4, 0x20AC},
                                                {0xA6, 0x0160},
                                                {0xA8, 0x0161},
                                                {0xB4, 0x017D},
                                                {0xB8, 0x017E},
                                                {0xBC, 0x0152},
                                                {0xBD, 0x0153},
                                                {0xBE, 0x0178}}};

/// ISO-8859-1, whose bytes are Unicode's first characters, but for `differences`.
ByteTable latin1_but(std::span<const ByteCharacter> differences) {
  ByteTable table{};
  std::iota(table.begin(), table.end(), 0);
  for (const auto& [byte, character] : differences) table[byte] = character;
  return table;
}

std::string plain_name(std::string_view encoding) {
  std::string name(encoding);
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == '_') c = '-';
  }
  return name;
}

/// The characters of an encoding of one byte a character beyond those that Expat reads itself
/// (UTF-8, UTF-16, ISO-8859-1, US-ASCII): windows-1252 (also cp1252) and ISO-8859-15 (also
/// latin-9), and latin1, l1, cp819 for ISO-8859-1. Upper and lower case, '-' and '_' are the same
/// (IANA's names and aliases). Nothing for any other.
std::optional<ByteTable> byte_table_of(std::string_view encoding) {
  const std::string name = plain_name(encoding);
  const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
  };
  if (is_one_of({"windows-1252", "cp1252", "cp-1252", "x-cp1252"})) return latin1_but(kWindows1252);
  if (is_one_of({"iso-8859-15", "iso8859-15", "latin-9", "latin9"})) return latin1_but(kLatin9);
  if (is_one_of({"latin1", "latin-1", "l1", "iso8859-1", "cp819"})) return latin1_but({});
  return std::nullopt;
}

/// What stands between namespace and name in Expat's names; no byte of a name.
constexpr char kSeparator = '\n';
constexpr std::size_t kMaxDepth = 1000;
/// A tag, comment or the like is parsed from its start whenever more of it has come, so an endless
/// one would cost the square of its length.
constexpr XML_Index kMaxToken = 16 << 20;

struct QualifiedName {
  std::string_view space;
  std::string_view local;
};

QualifiedName split(const XML_Char* text) {
  const std::string_view name(text);
  const std::size_t at = name.rfind(kSeparator);
  if (at == std::string_view::npos) return {{}, name};
  return {name.substr(0, at), name.substr(at + 1)};
}

Vocabulary vocabulary_of(std::string_view space) {
  constexpr std::string_view kGml = "http://www.opengis.net/gml";
  constexpr std::string_view kCityGml = "http://www.opengis.net/citygml/";
  if (space == kGml || space == "http://www.opengis.net/gml/3.2") return Vocabulary::gml;
  if (!space.starts_with(kCityGml)) return Vocabulary::other;
  space.remove_prefix(kCityGml.size());
  const std::size_t slash = space.rfind('/');
  const std::string_view version = space.substr(slash == std::string_view::npos ? 0 : slash + 1);
  if (version != "1.0" && version != "2.0" && version != "3.0") return Vocabulary::other;
  if (space == version) return Vocabulary::core;
  space = space.substr(0, slash);
  if (space == "building") return Vocabulary::building;
  if (space == "construction") return Vocabulary::construction;
  if (space == "generics") return Vocabulary::generics;
  return Vocabulary::other;
}

/// The key under which an attribute is kept; empty for those that are not.
std::string_view kept_key(const QualifiedName& name) {
  constexpr std::array<std::string_view, 4> kPlain{"srsName", "srsDimension", "orientation",
                                                   "name"};
  if (name.space.empty() && std::ranges::find(kPlain, name.local) != kPlain.end())
    return name.local;
  if (name.local == "id" && vocabulary_of(name.space) == Vocabulary::gml) return "id";
  if (name.local == "href" && name.space == "http://www.w3.org/1999/xlink") return "href";
  return {};
}

/// True for the elements that surfaces and lines are made of, and for a link to a template. Points
/// are none: addresses have some.
bool is_geometry(const QualifiedName& name) {
  constexpr std::array<std::string_view, 6> kNames{
      "Polygon", "PolygonPatch", "Triangle", "Rectangle", "LineString", "LineStringSegment"};
  const Vocabulary vocabulary = vocabulary_of(name.space);
  if (vocabulary == Vocabulary::gml) return std::ranges::find(kNames, name.local) != kNames.end();
  return vocabulary == Vocabulary::core && name.local == "ImplicitGeometry";
}

}  // namespace

struct CityGmlStream::State {
  State(Input& from, const TextName& called, bool notes);

  static void on_start(void* data, const XML_Char* name, const XML_Char** attributes);
  static void on_end(void* data, const XML_Char* name);
  static void on_text(void* data, const XML_Char* text, int size);
  static void on_doctype(void* data, const XML_Char* name, const XML_Char* system_id,
                         const XML_Char* public_id, int has_subset);
  static int on_encoding(void* data, const XML_Char* name, XML_Encoding* encoding);

  void start(const QualifiedName& name, const XML_Char** attributes);
  void pass_over(const QualifiedName& element, const XML_Char** attributes);
  void end();
  void check_root(const QualifiedName& name);
  void note_envelope(const XmlNode& bounds);
  void feed();
  void refuse(Fault fault);
  [[nodiscard]] Fault fault_of(XML_Error error, bool is_last) const;
  [[nodiscard]] std::string_view ahead() const;

  Input& input;
  const TextName& name;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser;
  /// The elements that are open, the root included.
  std::size_t depth = 0;
  /// The elements that are kept and open, from the member's object down. Only the innermost one
  /// gets children, so that the others stay where they are.
  std::vector<XmlNode*> open;
  XmlNode root;
  XML_Index root_start = 0;
  std::deque<XmlNode> ready;
  XML_Index fed = 0;
  /// The encoding that the file names, if Expat does not read it itself, and its characters.
  std::string encoding;
  std::optional<ByteTable> table;
  bool has_root = false;
  bool is_done = false;
  std::optional<Issue> issue;
  std::string srs_name;
  bool notes_unread = false;
  /// The object of the CityModel that is open and no building, and whether it has geometry.
  UnreadObject passed;
  bool has_geometry = false;
  std::vector<UnreadObject> unread;
};

CityGmlStream::State::State(Input& from, const TextName& called, bool notes)
    : input(from),
      name(called),
      parser(XML_ParserCreateNS(nullptr, kSeparator), &XML_ParserFree),
      notes_unread(notes) {
  XML_SetUserData(parser.get(), this);
  XML_SetElementHandler(parser.get(), &on_start, &on_end);
  XML_SetCharacterDataHandler(parser.get(), &on_text);
  XML_SetStartDoctypeDeclHandler(parser.get(), &on_doctype);
  XML_SetUnknownEncodingHandler(parser.get(), &on_encoding, this);
}

void CityGmlStream::State::on_start(void* data, const XML_Char* name, const XML_Char** attributes) {
  static_cast<State*>(data)->start(split(name), attributes);
}

void CityGmlStream::State::on_end(void* data, const XML_Char* /*name*/) {
  static_cast<State*>(data)->end();
}

void CityGmlStream::State::on_text(void* data, const XML_Char* text, int size) {
  State& state = *static_cast<State*>(data);
  if (!state.open.empty()) state.open.back()->text.append(text, static_cast<std::size_t>(size));
}

void CityGmlStream::State::on_doctype(void* data, const XML_Char* /*name*/,
                                      const XML_Char* /*system_id*/, const XML_Char* /*public_id*/,
                                      int /*has_subset*/) {
  static_cast<State*>(data)->refuse(
      {Code::E114,
       "has a document type declaration (DOCTYPE); expected none: entities are not read"});
}

int CityGmlStream::State::on_encoding(void* data, const XML_Char* name, XML_Encoding* encoding) {
  State& state = *static_cast<State*>(data);
  state.encoding = name;
  state.table = byte_table_of(name);
  if (!state.table) return XML_STATUS_ERROR;
  std::ranges::copy(*state.table, std::begin(encoding->map));
  encoding->data = nullptr;
  encoding->convert = nullptr;
  encoding->release = nullptr;
  return XML_STATUS_OK;
}

void CityGmlStream::State::start(const QualifiedName& element, const XML_Char** attributes) {
  if (issue) return;
  if (++depth > kMaxDepth)
    return refuse({Code::E503, fmt::format("elements are nested deeper than {}", kMaxDepth)});
  if (depth == 1) return check_root(element);
  XmlNode* node = nullptr;
  if (!open.empty()) {
    node = &open.back()->children.emplace_back();
    if (XML_GetCurrentByteIndex(parser.get()) - root_start >
        static_cast<XML_Index>(Input::kMaxBytes))
      return refuse({Code::E505, "a building of more than 4 GB"});
  } else {
    const Vocabulary vocabulary = vocabulary_of(element.space);
    const bool is_bounds =
        depth == 2 && element.local == "boundedBy" && vocabulary == Vocabulary::gml;
    const bool is_building =
        depth == 3 && element.local == "Building" && vocabulary == Vocabulary::building;
    if (!is_bounds && !is_building) return pass_over(element, attributes);
    root = {};
    root_start = XML_GetCurrentByteIndex(parser.get());
    node = &root;
  }
  node->vocabulary = vocabulary_of(element.space);
  node->name = element.local;
  node->line = static_cast<int>(XML_GetCurrentLineNumber(parser.get()));
  node->column = static_cast<int>(XML_GetCurrentColumnNumber(parser.get())) + 1;
  for (; *attributes != nullptr; attributes += 2)
    if (const std::string_view key = kept_key(split(*attributes)); !key.empty())
      node->attributes.emplace_back(key, attributes[1]);
  open.push_back(node);
}

/// What is not read: of objects of the CityModel it is noted that they are there.
void CityGmlStream::State::pass_over(const QualifiedName& element, const XML_Char** attributes) {
  if (!notes_unread || depth < 3) return;
  if (depth > 3) {
    has_geometry |= is_geometry(element);
    return;
  }
  passed = {"", std::string(element.local)};
  has_geometry = false;
  for (; *attributes != nullptr; attributes += 2)
    if (kept_key(split(*attributes)) == "id") passed.id = attributes[1];
}

void CityGmlStream::State::end() {
  if (issue) return;
  --depth;
  if (open.empty()) {
    if (depth == 2 && has_geometry) unread.push_back(std::move(passed));
    if (depth == 2) has_geometry = false;
    return;
  }
  open.pop_back();
  if (!open.empty()) return;
  if (root.name == "boundedBy")
    note_envelope(root);
  else
    ready.push_back(std::move(root));
}

void CityGmlStream::State::check_root(const QualifiedName& element) {
  has_root = true;
  if (element.local != "CityModel" || element.space.find("citygml") == std::string_view::npos)
    return refuse({Code::E107, fmt::format("is XML, but not CityGML: its root is {}; expected a "
                                           "CityModel",
                                           in_quotes(element.local))});
  if (vocabulary_of(element.space) != Vocabulary::core)
    refuse({Code::E115,
            fmt::format("a CityModel of the namespace {}; expected CityGML 1.0, 2.0 or 3.0 "
                        "(citygml-tools brings older files up to date)",
                        in_quotes(element.space))});
}

void CityGmlStream::State::note_envelope(const XmlNode& bounds) {
  for (const XmlNode& envelope : bounds.children) srs_name = envelope.attribute("srsName");
}

void CityGmlStream::State::feed() {
  const std::string_view chunk = input.read_some();
  fed += static_cast<XML_Index>(chunk.size());
  const bool is_last = chunk.empty();
  const XML_Status status = XML_Parse(parser.get(), chunk.data(), static_cast<int>(chunk.size()),
                                      static_cast<int>(is_last));
  is_done = is_last;
  if (issue) {
    is_done = true;
  } else if (status == XML_STATUS_ERROR) {
    refuse(fault_of(XML_GetErrorCode(parser.get()), is_last));
  } else if (!is_last && fed - XML_GetCurrentByteIndex(parser.get()) > kMaxToken) {
    refuse({Code::E505, "a tag, comment or other markup of more than 16 MB"});
  }
}

/// What stands in the parser's buffer from the current place on.
std::string_view CityGmlStream::State::ahead() const {
  int offset = 0;
  int size = 0;
  const char* context = XML_GetInputContext(parser.get(), &offset, &size);
  if (context == nullptr || offset < 0 || offset >= size) return {};
  return {context + offset, static_cast<std::size_t>(size - offset)};
}

Fault CityGmlStream::State::fault_of(XML_Error error, bool is_last) const {
  if (fed == 0) return {Code::E102, "the file is empty"};
  const std::string_view rest = ahead();
  if (error == XML_ERROR_UNKNOWN_ENCODING)
    return {Code::E103, fmt::format("the encoding {} that the XML declaration names is not read; "
                                    "expected UTF-8, UTF-16, ISO-8859-1, ISO-8859-15 or "
                                    "windows-1252",
                                    in_quotes(encoding))};
  if (error == XML_ERROR_INCORRECT_ENCODING)
    return {Code::E103, "the encoding that the XML declaration names is not that of the file"};
  if (!is_last && !has_root && !rest.starts_with('<'))
    return {Code::E107, fmt::format("is not XML: it starts with {}; expected a CityGML file",
                                    in_quotes(rest.substr(0, 8)))};
  if (error == XML_ERROR_INVALID_TOKEN && table && !rest.empty() &&
      (*table)[static_cast<unsigned char>(rest[0])] < 0)
    return {Code::E103, fmt::format("the byte 0x{:02X}, which {} does not have",
                                    static_cast<unsigned char>(rest[0]), encoding)};
  if (error == XML_ERROR_INVALID_TOKEN && !table &&
      find_non_utf8(rest.substr(0, 4)) == std::size_t{0})
    return {Code::E103, "a byte that is not UTF-8"};
  if (is_last && error == XML_ERROR_NO_ELEMENTS && !has_root)
    return {Code::E102, "the file has no element"};
  if (is_last) return {Code::E105, "the file ends inside the XML document"};
  return {Code::E113, fmt::format("not valid XML: {}", XML_ErrorString(error))};
}

void CityGmlStream::State::refuse(Fault fault) {
  if (issue) return;
  int offset = 0;
  int size = 0;
  const char* context = XML_GetInputContext(parser.get(), &offset, &size);
  const std::string_view text = context == nullptr
                                    ? std::string_view()
                                    : std::string_view(context, static_cast<std::size_t>(size));
  Issue found =
      error_at(name, text, static_cast<std::size_t>(std::max(offset, 0)), std::move(fault));
  if (text.empty()) found.excerpt.clear();
  found.place.line = static_cast<int>(XML_GetCurrentLineNumber(parser.get()));
  found.place.column = static_cast<int>(XML_GetCurrentColumnNumber(parser.get())) + 1;
  issue = std::move(found);
  is_done = true;
  XML_StopParser(parser.get(), XML_FALSE);
}

CityGmlStream::CityGmlStream(Input& input, const TextName& name, bool notes_unread)
    : state_(std::make_unique<State>(input, name, notes_unread)) {}

CityGmlStream::~CityGmlStream() = default;

const std::optional<Issue>& CityGmlStream::issue() const { return state_->issue; }
const std::string& CityGmlStream::srs_name() const { return state_->srs_name; }
std::vector<UnreadObject> CityGmlStream::take_unread() { return std::exchange(state_->unread, {}); }

std::optional<XmlNode> CityGmlStream::next() {
  while (state_->ready.empty() && !state_->is_done) state_->feed();
  if (state_->ready.empty()) return std::nullopt;
  XmlNode member = std::move(state_->ready.front());
  state_->ready.pop_front();
  return member;
}

}  // namespace oriel::detail
