// Files of blends: what they mean, and every way in which one can be wrong.
#include "scene/blend_file.hpp"
#include "scene/error.hpp"
#include "tools_support.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <string>
#include <vector>

using namespace ao::tools;

namespace {

const std::vector<std::string> objects{ "floor", "wall", "floor" };
const std::vector<std::string> materials{ "ground", "asphalt", "snow", "twin", "twin" };

int no_masks(const std::string& path)
{
    throw error(path + ": no such file");
}

blend_file parse(const std::string& text, const mask_loader& masks = no_masks)
{
    return parse_blends("dir/b.json", text, { objects, materials }, masks);
}

std::string error_of(const std::string& text, const mask_loader& masks = no_masks)
{
    try {
        static_cast<void>(parse(text, masks));
    } catch (const error& e) {
        return e.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("a file of blends becomes nodes, shared ones once, masks relative to it", "[tools][blend_file]")
{
    std::vector<std::string> loaded;
    const blend_file f = parse(R"({
  "blends": {
    "terrace": { "first": "asphalt", "second": "snow", "mask": "mask.png" },
    "all": { "first": "terrace", "second": { "first": "terrace", "second": "ground", "mask": "sub/../mask.png" }, "k": 0.25 }
  },
  "use": { "objects": { "floor": "all" }, "materials": { "ground": "snow", "twin": { "first": "snow", "second": "all", "k": 1 } } }
})",
                               [&](const std::string& path) {
                                   loaded.push_back(path);
                                   return 7;
                               });
    CHECK(loaded == std::vector<std::string>{ "dir/mask.png" });
    // Nodes: terrace, all, the one used for twin, the one inside all.
    REQUIRE(f.nodes.size() == 4);
    CHECK((f.nodes[0].first == 1 && f.nodes[0].second == 2 && f.nodes[0].mask == 7));
    CHECK((f.nodes[1].first == -1 && f.nodes[1].second == -4 && f.nodes[1].mask == ao::no_texture));
    CHECK(f.nodes[1].k == 0.25f);
    CHECK((f.nodes[2].first == 2 && f.nodes[2].second == -2 && f.nodes[2].k == 1.0f));
    CHECK((f.nodes[3].first == -1 && f.nodes[3].second == 0 && f.nodes[3].mask == 7));
    CHECK(f.of_object == std::vector<int>{ -2, blend_file::as_is, -2 });
    CHECK(f.of_material == std::vector<int>{ 2, blend_file::as_is, blend_file::as_is, -3, -3 });
}

TEST_CASE("a file of blends may leave out everything", "[tools][blend_file]")
{
    const blend_file f = parse("\xef\xbb\xbf{}");
    CHECK(f.nodes.empty());
    CHECK(f.of_object == std::vector<int>(3, blend_file::as_is));
    CHECK(f.of_material == std::vector<int>(5, blend_file::as_is));
}

TEST_CASE("what is wrong with a file of blends is named with line, column and path", "[tools][blend_file]")
{
    const auto blend = [](const std::string& body) { return "{\"blends\": {\n  \"x\": " + body + "}}"; };
    const std::pair<std::string, std::string> cases[] = {
        { "", "dir/b.json:1:1: syntax error" },
        { "{\n  \"blends\": {,}\n}", "dir/b.json:2:14: syntax error" },
        { "{} {}", "dir/b.json:1:4: syntax error" },
        { "{\"blends\": {\"a\": nul}}", "dir/b.json:1:21: syntax error" },
        { "{\"use\": \"\xff\"}", "dir/b.json:1:10: syntax error" },
        { "[]", "dir/b.json:1:1: /: must be an object, is an array" },
        { "{\"blend\": {}}", "dir/b.json:1:11: /blend: unknown member; known are blends, use" },
        { "{\"blends\": []}", "dir/b.json:1:12: /blends: must be an object of blends by name" },
        { "{\"use\": {\"object\": {}}}", "dir/b.json:1:20: /use/object: unknown member" },
        { "{\"use\": {\"objects\": 1}}", "/use/objects: must be an object by name of object" },
        { "{\"use\": {\"objects\": {\"roof\": \"snow\"}}}",
          "dir/b.json:1:30: /use/objects/roof: the model has no object of this name" },
        { "{\"use\": {\"materials\": {\"snow\": \"ice\"}}}", "/use/materials/snow: no material or blend named 'ice'" },
        { "{\"use\": {\"materials\": {\"snow\": 4}}}", "must be the name of a material or blend" },
        { blend("7"), "dir/b.json:2:8: /blends/x: must be an object, is a number" },
        { blend("{}"), "/blends/x: has no member 'first'" },
        { blend("{\"first\": \"snow\", \"k\": 0}"), "/blends/x: has no member 'second'" },
        { blend("{\"first\": \"snow\", \"second\": \"snwo\", \"k\": 0}"),
          "dir/b.json:2:36: /blends/x/second: no material or blend named 'snwo'" },
        { blend("{\"first\": \"snow\", \"second\": \"twin\", \"k\": 0}"),
          "/blends/x/second: the model has 2 materials named 'twin'" },
        { blend("{\"first\": \"snow\", \"second\": \"ground\"}"), "dir/b.json:2:8: /blends/x: needs k or mask" },
        { blend("{\"first\": \"snow\", \"second\": \"ground\", \"k\": 0, \"mask\": \"m\"}"), "/blends/x: has both k and mask" },
        { blend("{\"first\": \"snow\", \"second\": \"ground\", \"k\": 1.001}"), "/blends/x/k: must be 0 to 1, is 1.001" },
        { blend("{\"first\": \"snow\", \"second\": \"ground\", \"k\": -1e-30}"), "/blends/x/k: must be 0 to 1" },
        { blend("{\"first\": \"snow\", \"second\": \"ground\", \"k\": 1e999}"), "dir/b.json:2:" },
        { blend("{\"first\": \"snow\", \"second\": \"ground\", \"k\": NaN}"), "syntax error" },
        { blend("{\"first\": \"snow\", \"second\": \"ground\", \"k\": \"0.5\"}"), "/blends/x/k: must be a number, is a string" },
        { blend("{\"first\": \"snow\", \"second\": \"ground\", \"mask\": \"m.png\"}"),
          "/blends/x/mask: dir/m.png: no such file" },
        { blend("{\"first\": \"snow\", \"second\": \"ground\", \"mask\": \"\"}"),
          "/blends/x/mask: must be the name of a picture" },
        { blend("{\"first\": \"snow\", \"second\": \"ground\", \"K\": 0}"), "/blends/x/K: unknown member" },
        { blend("{\"first\": \"snow\", \"second\": \"ground\", \"k\": 0, \"k\": 1}"), "/blends/x: a second member 'k'" },
        { "{\"blends\": {\"snow\": {}}}", "/blends/snow: the model has a material of this name" },
        { blend("{\"first\": \"x\", \"second\": \"snow\", \"k\": 0}"), "/blends/x/first: a blend contains itself: x -> x" },
        { "{\"blends\": {\n"
          "\"a\": {\"first\": \"snow\", \"second\": {\"first\": \"b\", \"second\": \"snow\", \"k\": 0}, \"k\": 0},\n"
          "\"b\": {\"first\": \"c\", \"second\": \"snow\", \"k\": 0},\n"
          "\"c\": {\"first\": \"snow\", \"second\": \"b\", \"k\": 0}}}",
          "dir/b.json:4:34: /blends/c/second: a blend contains itself: b -> c -> b" },
    };
    for (const auto& [text, reason] : cases) {
        INFO(text);
        const std::string message = error_of(text);
        INFO(message);
        CHECK(message.find(reason) != std::string::npos);
        CHECK(message.rfind("dir/b.json:", 0) == 0);
        CHECK(message.find('\n') == std::string::npos);
    }
}

TEST_CASE("a blend shared by two parents is no cycle", "[tools][blend_file]")
{
    const blend_file f = parse(R"({"blends": {
"top": {"first": "left", "second": "right", "k": 0.5},
"left": {"first": "base", "second": "snow", "k": 0.5},
"right": {"first": "snow", "second": "base", "k": 0.5},
"base": {"first": "snow", "second": "ground", "k": 0.5}}})");
    CHECK(f.nodes.size() == 4);
    CHECK(f.nodes[1].first == f.nodes[2].second);
}

TEST_CASE("nesting a hundred thousand deep needs no stack", "[tools][blend_file]")
{
    constexpr int depth = 100000;
    std::string text = "{\"blends\": {\"x\": ";
    for (int i = 0; i < depth; ++i)
        text += "{\"second\": \"snow\", \"k\": 0.5, \"first\": ";
    text += "\"ground\"" + std::string(depth, '}') + "}}";
    const blend_file f = parse(text);
    CHECK(f.nodes.size() == depth);
    CHECK(f.nodes.back().first == 0);

    // The same with an error inside, and with brackets that mean nothing.
    text.replace(text.find("\"ground\""), 8, "\"grund\"");
    const std::string message = error_of(text);
    CHECK(message.find("/blends/x/first/first/.../first/first/first/first: no material or blend named 'grund'") !=
          std::string::npos);
    CHECK(error_of("{\"blends\": " + std::string(depth, '[') + std::string(depth, ']') + "}").find("/blends: must be") !=
          std::string::npos);
    CHECK(error_of(std::string(depth, '[')).find("syntax error") != std::string::npos);
}

TEST_CASE("a long cycle and long words still make one short line", "[tools][blend_file]")
{
    constexpr int count = 1000;
    std::string text = "{\"blends\": {";
    for (int i = 0; i < count; ++i)
        text += (i == 0 ? "\"n" : ", \"n") + std::to_string(i) + "\": {\"first\": \"n" + std::to_string((i + 1) % count) +
                "\", \"second\": \"snow\", \"k\": 0.5}";
    const std::string cycle = error_of(text + "}}");
    CHECK(cycle.find("n0 -> n1 -> n2 -> n3 -> n4 -> ... -> ") != std::string::npos);
    CHECK(cycle.size() < 200);
    const std::string word(100000, 'w');
    CHECK(error_of("{\"use\": {\"objects\": {\"floor\": \"" + word + "\"}}}").size() < 200);
    CHECK(error_of("{\"use\": {\"objects\": {\"" + word + "\": \"snow\"}}}").size() < 200);
    CHECK(error_of("{\"use\": {\"objects\": {\"a\\nb\\u0000\": \"snow\"}}}").find('\n') == std::string::npos);
}

TEST_CASE("the documented blends load", "[tools][blend_file]")
{
    const std::vector<std::string> floor{ "floor" };
    const std::vector<std::string> all{ "asphalt", "snow", "ice", "ground" };
    const blend_file f =
        parse_blends("docs/scenes.md", documented_example("blend"), { floor, all }, [](const std::string&) { return 0; });
    CHECK(f.nodes.size() == 3);
    CHECK(f.of_object == std::vector<int>{ -2 });
    CHECK(f.of_material.back() == -1);
}
