#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "devlearn/error.hpp"
#include "json.hpp"

using namespace devlearn;

namespace {

constexpr json::Limits kLimits{1 << 20, 4, 20};

// What reading the text, and then `use` of its root, is refused for: the field, and the message.
struct Refusal {
  std::string field, message;
};
template <typename Use>
Refusal refusal(const std::string& text, const Use& use) {
  try {
    use(json::Document(text, "it", kLimits, "whole").root());
  } catch (const FileError& error) {
    CHECK(error.file() == "it");
    CHECK_FALSE(error.value().empty());
    CHECK_FALSE(error.allowed().empty());
    CHECK(std::string(error.what()).size() < 600);
    for (const char c : std::string(error.what())) REQUIRE((c >= ' ' && c <= '~'));
    return {error.field(), error.what()};
  }
  return {"", "accepted"};
}
Refusal refusal(const std::string& text) {
  return refusal(text, [](const json::Node&) {});
}

void refused(const std::string& text, const std::string& field, const std::string& part) {
  CAPTURE(text.substr(0, 200));
  const Refusal found = refusal(text);
  CHECK(found.field == field);
  CAPTURE(found.message);
  CHECK(found.message.find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("what a text says is read as it is said") {
  const std::string text =
      R"( {"b": [0, -3, 2.5, 1e3, 18446744073709551615], "a": {"": "\u00fc\n\ud83d\ude00"},
    "none": [{}, [], null, true]} )";
  const json::Document document(text, "it", {1000, 3, 15});
  const json::Node root = document.root();
  CHECK(root["b"].size() == 5);
  CHECK(root["b"][0].number() == 0.0);
  CHECK(root["b"][1].number() == -3.0);
  CHECK(root["b"][2].number() == 2.5);
  CHECK(root["b"][3].number() == 1000.0);
  CHECK(root["b"][4].whole_number() == std::numeric_limits<std::uint64_t>::max());
  CHECK(root["a"][""].text() == "\xc3\xbc\n\xf0\x9f\x98\x80");
  CHECK(root.has("none"));
  CHECK_FALSE(root.has("nothing"));
  std::string names;
  root.each_field([&](const std::string& name, const json::Node&) { names += name + " "; });
  CHECK(names == "a b none ");
  std::size_t count = 0;
  root["b"].each_element([&](const json::Node&) { ++count; });
  CHECK(count == 5);
}

TEST_CASE("a text may be as large as its limits, and no larger") {
  CHECK(refusal("[[[[]]]]").message == "accepted");
  refused("[[[[[]]]]]", "[0][0][0][0]", "at most 4 levels");
  refused(R"({"a": [{"b": [{)", "a[0].b[0]", "at most 4 levels");
  refused(std::string(1 << 20, '['), "[0][0][0][0]", "at most 4 levels");

  const std::string twenty = "[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18";
  CHECK(refusal(twenty + "]").message == "accepted");
  refused(twenty + ",19]", "[19]", "at most 20 values");
  refused(twenty + ",{", "[19]", "at most 20 values");
  refused("[" + twenty, "[0][18]", "at most 20 values");

  CHECK(refusal("1" + std::string((1 << 20) - 1, ' ')).message == "accepted");
  refused("1" + std::string(1 << 20, ' '), "whole", "at most 1 MiB");
}

TEST_CASE("a field given twice is refused by its path") {
  refused(R"({"a": 1, "a": 1})", "a", "each field once");
  refused(R"([0, {"a": {"b": [], "c": 1, "b": []}}])", "[1].a.b", "each field once");
  refused(R"({"a": 1, "\u0061": 2})", "a", "each field once");
}

TEST_CASE("a number beyond a double is refused by its path") {
  refused(R"({"a": [1, 1e999]})", "a[1]", "1e999");
  refused(R"({"a": {"b": -1e999}})", "a.b", "-1e999");
  refused("1e999", "whole", "1e999");
}

TEST_CASE("what is not JSON in UTF-8, and only that, is refused with line and column") {
  for (const char* text : {"",
                           " ",
                           "{",
                           "[",
                           "[1,]",
                           "[1 2]",
                           "{1: 2}",
                           "{\"a\"}",
                           "nul",
                           "NaN",
                           "Infinity",
                           "-",
                           "01",
                           "0x1",
                           "+1",
                           ".5",
                           "1.",
                           "'a'",
                           "\"a",
                           "\"\\x\"",
                           "\"\t\"",
                           "// a\n1",
                           "/**/ 1",
                           "1 2",
                           "{} {}",
                           "{}x",
                           "]",
                           "\"\xff\"",
                           "\"\xc0\x80\"",
                           "\"\xed\xa0\x80\"",
                           "\"\xf4\x90\x80\x80\"",
                           "\"\xc3\"",
                           "\"\\ud800\"",
                           "\"\\udc00\"",
                           "\"\\ud800\\u0041\"",
                           "\xff"}) {
    refused(text, "whole", "line 1, column");
  }
  refused("[\n  1,\n  oops]", "whole", "line 3, column");
  refused("\"" + std::string(100000, 'a'), "whole", "...");
  // Where nlohmann-json would look away.
  refused("\xef\xbb\xbf{}", "whole", "byte order mark");
  refused(std::string("{}\0 rubbish", 11), "whole", "a byte of zero");
  refused(std::string("\0", 1), "whole", "a byte of zero");
}

TEST_CASE("what is asked for and not there is refused by its path") {
  const std::string text = R"({"a": {"b": [1, true, "x", -1, 1.5, {"c": null}]}})";
  const auto asked = [&](const auto& use) {
    return refusal(text, [&](const json::Node& root) { use(root["a"]); });
  };
  using N = const json::Node&;
  CHECK(asked([](N a) { a["c"]; }).field == "a.c");
  CHECK(asked([](N a) { a["c"]; }).message.find("required") != std::string::npos);
  CHECK(asked([](N a) { a.size(); }).field == "a");
  CHECK(asked([](N a) { a["b"]["c"]; }).field == "a.b");
  CHECK(asked([](N a) { a["b"].has("c"); }).field == "a.b");
  CHECK(asked([](N a) { a["b"][5]["c"].text(); }).field == "a.b[5].c");
  CHECK(asked([](N a) { a["b"].text(); }).field == "a.b");
  CHECK(asked([](N a) { a["b"].text(); }).message.find("an array of 6") != std::string::npos);
  CHECK(asked([](N a) { a["b"][2].number(); }).message.find("\"x\"") != std::string::npos);
  for (const std::size_t i : {1, 2, 5}) {
    const std::string field = "a.b[" + std::to_string(i) + "]";
    CHECK(asked([&](N a) { a["b"][i].number(); }).field == field);
  }
  for (const std::size_t i : {1, 2, 3, 4, 5}) {
    const std::string field = "a.b[" + std::to_string(i) + "]";
    CHECK(asked([&](N a) { a["b"][i].whole_number(); }).field == field);
  }
  CHECK(refusal("[18446744073709551616]", [](N root) { root[0].whole_number(); }).field == "[0]");
  CHECK(refusal("3", [](N root) { root.text(); }).field == "whole");
  CHECK(asked([](N a) { a.require_known({"b", "c"}); }).message == "accepted");
  const Refusal unknown = asked([](N a) { a.require_known({"c", "d"}); });
  CHECK(unknown.field == "a.b");
  CHECK(unknown.message.find("one of c, d") != std::string::npos);
}

TEST_CASE("a message repeats no long name, and none in other letters than ASCII") {
  const std::string name(5000, 'a');
  const Refusal found = refusal("{\"" + name + "\": {\"" + name + "\": 1e999}}");
  CHECK(found.field.size() < 200);
  CHECK(refusal("{\"\xc3\xbc\": 1e999}").field == "??");
  CHECK(refusal("{\"\": 1e999}").field == "\"\"");
  CHECK(refusal("[\"" + name + "\"]", [](const json::Node& root) { root[0].number(); }).field ==
        "[0]");
}

TEST_CASE("a text in quotes reads back as it was") {
  const std::string text = "a\"\\/\b\f\n\r\t\x01\x1f\x7f \xc3\xbc \xf0\x9f\x98\x80";
  CHECK(json::is_utf8(text));
  CHECK(json::Document(json::quoted(text), "it", kLimits).root().text() == text);
  for (const char* other : {"\xff", "\xc0\x80", "\xed\xa0\x80", "\xc3"}) {
    CHECK_FALSE(json::is_utf8(other));
  }
}
