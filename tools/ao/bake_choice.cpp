#include "ao/bake_options.hpp"
#include "ao/option_words.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace ao::tools {
namespace {

using json = nlohmann::ordered_json;

// Words and flags by the names of their options.
template <class Choice, class Text, class Flag>
void for_choices(Choice& c, const Text& text, const Flag& flag)
{
    text("rule", c.rule);
    text("rule_text", c.rule_text);
    text("bits", c.bits);
    text("coefficient", c.coefficient);
    text("distance", c.distance);
    text("falloff", c.falloff);
    text("sides", c.sides);
    text("occluders", c.occluders);
    text("normals", c.normals);
    text("ground", c.ground);
    flag("negative_weights", c.negative_weights);
    flag("rotate_per_vertex", c.rotate_per_vertex);
    flag("bent_normals", c.bent_normals);
}

double finite(const char* option, const std::string& text)
{
    const double x = number<double>(option, text);
    if (!std::isfinite(x))
        throw error(std::string(option) + ": '" + one_line(text) + "' is not finite");
    return x;
}

void read_normals(const std::string& text, bake_wanted& w)
{
    if (text == "own") {
        w.normals = bake_normals::own;
    }
    else if (text == "smooth") {
        w.normals = bake_normals::smooth;
    }
    else if (text.rfind("crease:", 0) == 0) {
        w.normals = bake_normals::crease;
        w.crease = finite("--normals", text.substr(7));
        if (w.crease < 0.0 || w.crease > 180.0)
            throw error("--normals: a crease of 0 to 180 degrees");
    }
    else {
        throw error("--normals: '" + one_line(text) + "' is none of own|smooth|crease:DEGREES");
    }
}

void read_ground(const std::string& text, bake_wanted& w)
{
    if (text.empty())
        return;
    const std::vector<std::string> words = split(text, ',');
    ao::bake_settings& s = w.settings;
    s.ground = true;
    if (words.size() == 4) {
        for (int i = 0; i < 3; ++i)
            s.ground_up[i] = finite("--ground", words[static_cast<std::size_t>(i)]);
    }
    else if (words.size() <= 2) {
        static constexpr std::array<std::pair<std::string_view, int>, 9> axes{ {
            { "x", 0 },
            { "-x", 1 },
            { "y", 2 },
            { "-y", 3 },
            { "z", 4 },
            { "-z", 5 },
            { "+x", 0 },
            { "+y", 2 },
            { "+z", 4 },
        } };
        const int axis = choose("--ground", words[0], axes);
        s.ground_up = glm::dvec3(0.0);
        s.ground_up[axis / 2] = axis % 2 == 0 ? 1.0 : -1.0;
        if (words.size() == 1)
            w.ground_beneath = axis;
    }
    else {
        throw error("--ground: '" + one_line(text) + "' is none of AXIS | AXIS,HEIGHT | X,Y,Z,HEIGHT");
    }
    if (!w.ground_beneath)
        s.ground_height = finite("--ground", words.back());
}

} // namespace

std::string to_text(const bake_choice& c)
{
    json j;
    const auto keep = [&](const char* name, const auto& value) { j[name] = value; };
    for_choices(c, keep, keep);
    j["seed"] = c.seed;
    return j.dump(-1, ' ', false, json::error_handler_t::replace);
}

bake_choice choice_from(const std::string& text)
{
    bake_choice c;
    try {
        const json j = json::parse(text);
        for_choices(
            c, [&](const char* name, std::string& value) { value = j.at(name).get<std::string>(); },
            [&](const char* name, bool& value) { value = j.at(name).get<bool>(); });
        c.seed = j.at("seed").get<long long>();
    } catch (const json::exception&) {
        throw error("the part is damaged");
    }
    return c;
}

ao::bake_route route_of(const bake_choice& c)
{
    return c.bits == "embree" ? bake_route::embree : c.bits == "cube" ? bake_route::cube : bake_route::automatic;
}

bake_wanted read_choice(const bake_choice& c)
{
    static constexpr std::array<std::pair<std::string_view, bake_coefficient>, 2> coefficients{ {
        { "uniform", bake_coefficient::uniform },
        { "cosine", bake_coefficient::cosine },
    } };
    static constexpr std::array<std::pair<std::string_view, bake_falloff>, 3> falloffs{ {
        { "none", bake_falloff::none },
        { "linear", bake_falloff::linear },
        { "smooth", bake_falloff::smooth },
    } };
    static constexpr std::array<std::pair<std::string_view, bake_sides>, 2> sides{ {
        { "both", bake_sides::both },
        { "front", bake_sides::front },
    } };
    static constexpr std::array<std::pair<std::string_view, bake_occluders>, 3> occluders{ {
        { "all", bake_occluders::all },
        { "own", bake_occluders::own_object },
        { "others", bake_occluders::other_objects },
    } };
    bake_wanted w;
    ao::bake_settings& s = w.settings;
    s.coefficient = choose("--coefficient", c.coefficient, coefficients);
    s.falloff = choose("--falloff", c.falloff, falloffs);
    s.sides = choose("--sides", c.sides, sides);
    s.occluders = choose("--occluders", c.occluders, occluders);
    if (c.distance != "infinite") {
        s.distance = number<double>("--distance", c.distance);
        if (!(s.distance > 0.0 && s.distance <= 1e6))
            throw error("--distance: a share of the diagonal greater than 0, at most 1000000, or infinite");
    }
    if (c.seed < 0 || c.seed > 0xffffffffLL)
        throw error("--seed: 0 to 4294967295");
    s.seed = static_cast<std::uint32_t>(c.seed);
    s.rotate_per_vertex = c.rotate_per_vertex;
    s.bent_normals = c.bent_normals;
    read_normals(c.normals, w);
    read_ground(c.ground, w);
    if (const auto wrong = validate(s))
        throw error(std::string(wrong->reason()));
    return w;
}

} // namespace ao::tools
