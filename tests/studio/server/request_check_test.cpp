#include "studio/server/request_check.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel::studio;

namespace {

const ServedAt kServed{8080, "0123456789abcdef0123456789abcdef"};

/// A request of the page that is answered.
RequestHead good_verb() {
  RequestHead head;
  head.method = "POST";
  head.path = "/api/state";
  head.host = "127.0.0.1:8080";
  head.origin = "http://127.0.0.1:8080";
  head.fetch_site = "same-origin";
  head.token = kServed.token;
  head.content_type = "application/json";
  head.content_length = "2";
  return head;
}

/// The page itself, by the address that was printed.
RequestHead good_page() {
  RequestHead head;
  head.method = "GET";
  head.path = "/";
  head.host = "localhost:8080";
  head.token = kServed.token;
  return head;
}

int status_of(const RequestHead& head) {
  const auto refusal = refusal_of(head, kServed);
  return refusal ? refusal->status : 200;
}

}  // namespace

TEST_SUITE("studio/server") {
  TEST_CASE("what the page asks is answered") {
    CHECK(status_of(good_verb()) == 200);
    CHECK(status_of(good_page()) == 200);
    RequestHead script = good_page();
    script.path = "/studio.js";
    script.token.reset();
    CHECK(status_of(script) == 200);
  }

  TEST_CASE("a name that was made to point here is refused") {
    for (const char* host : {"evil.example:8080", "evil.example", "127.0.0.1", "127.0.0.1:80",
                             "127.0.0.1:80800", "localhost:8080.evil.example", "[::1]:8080", ""}) {
      CAPTURE(host);
      RequestHead verb = good_verb(), page = good_page();
      verb.host = page.host = host;
      CHECK(status_of(verb) == 403);
      CHECK(status_of(page) == 403);
    }
    RequestHead nameless = good_page();
    nameless.host.reset();
    CHECK(status_of(nameless) == 403);
  }

  TEST_CASE("a page of another site is refused though it knows the token") {
    for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1:8080", "",
                               "http://127.0.0.1:8081", "http://127.0.0.1:8080.evil.example"}) {
      CAPTURE(origin);
      RequestHead verb = good_verb();
      verb.origin = origin;
      CHECK(status_of(verb) == 403);
    }
    for (const char* site : {"cross-site", "same-site", ""}) {
      RequestHead verb = good_verb(), script = good_page();
      verb.fetch_site = script.fetch_site = site;
      script.path = "/studio.js";
      CHECK(status_of(verb) == 403);
      CHECK(status_of(script) == 403);
    }
  }

  TEST_CASE("a link from elsewhere may lead to the page as far as it has the token") {
    RequestHead page = good_page();
    page.fetch_site = "cross-site";
    CHECK(status_of(page) == 200);
    page.token = "0";
    CHECK(status_of(page) == 403);
  }

  TEST_CASE("without the token nothing is said") {
    for (RequestHead head : {good_verb(), good_page()}) {
      head.token.reset();
      CHECK(status_of(head) == 403);
      for (const std::string& token :
           {std::string(), kServed.token.substr(1), kServed.token + "0", std::string(32, '0')}) {
        head.token = token;
        CHECK(status_of(head) == 403);
      }
    }
    RequestHead head = good_verb();
    head.token = "";
    CHECK(refusal_of(head, {8080, ""})->status == 403);
  }

  TEST_CASE("there are the files of the page and verbs and nothing else") {
    for (const char* path :
         {"", "/index.html", "/..", "/../etc/passwd", "//etc/passwd", "/studio.js/", "/api",
          "/api/", "/api/../state", "/api/state/..", "/api/State", "/api/a b", "/api/__proto__1",
          "/./", "/api/aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"}) {
      CAPTURE(path);
      RequestHead verb = good_verb(), page = good_page();
      verb.path = page.path = path;
      CHECK(status_of(verb) == 404);
      CHECK(status_of(page) == 404);
    }
    CHECK(verb_of("/api/__proto__") == "__proto__");  // for the session, which knows no such verb
  }

  TEST_CASE("verbs are asked by POST and files are read") {
    for (const char* method : {"GET", "HEAD", "PUT", "DELETE", "OPTIONS", "PATCH"}) {
      RequestHead verb = good_verb();
      verb.method = method;
      CHECK(status_of(verb) == 405);
    }
    RequestHead page = good_page();
    page.method = "POST";
    CHECK(status_of(page) == 405);
  }

  TEST_CASE("a form of another page is no request of ours") {
    for (const char* type : {"text/plain", "application/x-www-form-urlencoded",
                             "multipart/form-data; boundary=a", "application/jsonp", ""}) {
      RequestHead verb = good_verb();
      verb.content_type = type;
      CHECK(status_of(verb) == 415);
    }
    RequestHead verb = good_verb();
    verb.content_type.reset();
    CHECK(status_of(verb) == 415);
    verb.content_type = "application/json; charset=utf-8";
    CHECK(status_of(verb) == 200);
  }

  TEST_CASE("a body says how long it is and has a limit") {
    RequestHead verb = good_verb();
    verb.content_length = std::to_string(kMostBodyBytes);
    CHECK(status_of(verb) == 200);
    for (const std::string& length :
         {std::to_string(kMostBodyBytes + 1), std::string("99999999999999999999999999")}) {
      verb.content_length = length;
      CHECK(status_of(verb) == 413);
    }
    for (const char* length : {"-1", "2 ", "0x2", "two", "", "+2"}) {
      CAPTURE(length);
      verb.content_length = length;
      CHECK(status_of(verb) == 400);
    }
    verb.content_length.reset();
    CHECK(status_of(verb) == 411);
    verb.content_length = "2";
    verb.has_transfer_encoding = true;
    CHECK(status_of(verb) == 411);
  }

  TEST_CASE("neither parts of an answer nor compressed bodies are taken") {
    RequestHead page = good_page(), verb = good_verb();
    page.has_range = true;
    CHECK(status_of(page) == 400);
    verb.has_content_encoding = true;
    CHECK(status_of(verb) == 415);
  }
}
