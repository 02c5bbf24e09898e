#include "lights_file.hpp"

#include "environment.hpp"
#include "error.hpp"
#include "json_file.hpp"

#include <filesystem>

namespace ao::tools {
namespace {

glm::vec3 vector(const json_value& value, double low = -1.0e30)
{
    const std::vector<float> v = value.numbers(3, low);
    return { v[0], v[1], v[2] };
}

ao::light read_light(const json_value& value)
{
    value.allow({ "type", "towards", "position", "color", "attenuation" });
    ao::light l;
    const json_value type = value.at("type");
    const bool point = type.string() == "point";
    if (!point && type.string() != "directional")
        type.fail("must be 'directional' or 'point', is " + in_quotes(type.string()));
    l.type = point ? ao::light_type::point : ao::light_type::directional;
    const auto misplaced = value.find(point ? "towards" : "position");
    if (misplaced)
        misplaced->fail(point ? "belongs to a directional light" : "belongs to a point light");
    const json_value where = value.at(point ? "position" : "towards");
    l.vector = vector(where);
    if (!point && l.vector == glm::vec3(0.0f))
        where.fail("must not be zero");
    l.color = vector(value.at("color"), 0);
    if (const auto attenuation = value.find("attenuation")) {
        if (!point)
            attenuation->fail("belongs to a point light");
        l.attenuation = vector(*attenuation, 0);
        if (l.attenuation == glm::vec3(0.0f))
            attenuation->fail("must not be all zero");
    }
    return l;
}

} // namespace

scene_lights default_lights()
{
    scene_lights s;
    ao::light sun;
    sun.vector = { -0.45f, 0.75f, 0.48f };
    sun.color = { 0.85f, 0.8f, 0.7f };
    s.lights.push_back(sun);
    s.ambient = ao::ambient_light(glm::vec3(0.42f, 0.46f, 0.52f));
    return s;
}

scene_lights no_lights()
{
    scene_lights s;
    s.ambient = ao::ambient_light(glm::vec3(1.0f));
    return s;
}

scene_lights parse_lights(const std::string& name, const std::string& text, const environment_loader& load)
{
    const json_file file(name, text);
    const json_value root = file.root();
    root.allow({ "ambient", "lights" });
    scene_lights s;
    if (const auto ambient = root.find("ambient")) {
        if (ambient->is_object()) {
            ambient->allow({ "environment" });
            const json_value picture = ambient->at("environment");
            const std::filesystem::path path = std::filesystem::path(name).parent_path() / picture.string();
            if (picture.string().empty())
                picture.fail("must be the name of a picture");
            try {
                s.ambient = load(path.lexically_normal().string());
            } catch (const error& e) {
                picture.fail(e.what());
            }
        }
        else {
            s.ambient = ao::ambient_light(vector(*ambient, 0));
        }
    }
    if (const auto lights = root.find("lights")) {
        if (!lights->is_array())
            lights->fail("must be an array of lights");
        for (const json_value& light : lights->children())
            s.lights.push_back(read_light(light));
    }
    return s;
}

scene_lights choose_lights(const std::string& words)
{
    if (words == "default")
        return default_lights();
    if (words == "none")
        return no_lights();
    return parse_lights(words, json_file::read(words), load_environment);
}

} // namespace ao::tools
