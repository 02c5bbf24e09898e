#include "courtyard.hpp"

#include "courtyard_parts.hpp"
#include "courtyard_screen.hpp"
#include "courtyard_textures.hpp"
#include "tangents.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace ao::tools {
namespace {

using glm::vec3;

constexpr float half_turn = 3.14159265f;
constexpr float terrace_picture = 24.0f; // metres that the picture of the drifts covers

void ground(mesh_builder& m, parts::dice& d)
{
    m.begin("ground", "earth");
    m.quad({ -60.0f, -0.03f, 20.0f }, { 60.0f, -0.03f, 20.0f }, { 60.0f, -0.03f, -45.0f }, { -60.0f, -0.03f, -45.0f });

    m.begin("paving", "paving");
    constexpr int slabs = 16;
    constexpr float pitch = 20.0f / slabs, joint = 0.015f;
    for (int row = 0; row < slabs; ++row)
        for (int column = 0; column < slabs; ++column) {
            const float x = -10.0f + pitch * static_cast<float>(column), z = -10.0f + pitch * static_cast<float>(row);
            const float top = d.between(-0.004f, 0.004f);
            m.slab({ x + joint, -0.08f, z + joint }, { x + pitch - joint, top, z + pitch - joint }, 0.012f);
        }
}

// Left: x from -10.4 to -7.
void arcade(mesh_builder& m)
{
    constexpr float pitch = 3.2f, front = -7.0f, back = -10.2f, first = -9.6f, spring = 3.0f, top = 5.0f;
    constexpr int bays = 6;
    constexpr float last = first + pitch * bays;

    for (int i = 0; i <= bays; ++i) {
        m.begin("arcade column " + std::to_string(i), "stone");
        parts::column(m, { front, 0.005f, first + pitch * static_cast<float>(i) }, 0.24f, spring - 0.005f);
    }
    m.begin("arches", "plaster");
    parts::arches(m, front, 0.28f, first, last, spring, top, 1.3f, bays);

    m.begin("arcade wall", "plaster");
    m.box({ back - 0.4f, -0.05f, first - 0.4f }, { back, top + 0.01f, last + 0.4f });

    m.begin("vault", "plaster");
    constexpr float radius = (front - 0.28f - back) / 2.0f, middle = back + radius;
    m.sheet(
        [](float u, float v) {
            return vec3(middle + radius * std::cos(half_turn * u), spring + 0.2f + radius * std::sin(half_turn * u),
                        first + (last - first) * v);
        },
        32, 12);

    m.begin("arcade cornice", "stone");
    m.box({ back - 0.5f, top + 0.02f, first - 0.5f }, { front + 0.45f, top + 0.18f, last + 0.5f });
    m.box({ back - 0.4f, top + 0.19f, first - 0.4f }, { front + 0.35f, top + 0.45f, last + 0.4f });
}

// Right: x from 6.5 to 9.5, columns that carry beams.
void pergola(mesh_builder& m, parts::dice& d)
{
    constexpr float pitch = 3.2f, inner = 6.6f, outer = 9.4f, first = -8.0f, height = 3.0f;
    constexpr int bays = 5;
    constexpr float last = first + pitch * bays;
    for (int i = 0; i <= bays; ++i) {
        m.begin("pergola column " + std::to_string(i), "stone");
        parts::column(m, { inner, 0.005f, first + pitch * static_cast<float>(i) }, 0.2f, height - 0.005f);
    }
    m.begin("pergola beams", "wood");
    m.box({ inner - 0.12f, height + 0.005f, first - 0.5f }, { inner + 0.12f, height + 0.28f, last + 0.5f });
    for (float z = first - 0.2f; z < last + 0.3f; z += 0.8f)
        m.box({ inner - 0.5f, height + 0.285f, z - 0.05f }, { outer + 0.75f, height + 0.46f, z + 0.05f });
    for (float x = inner + 0.2f; x < outer + 0.5f; x += 0.45f)
        m.box({ x - 0.025f, height + 0.465f, first - 0.4f }, { x + 0.025f, height + 0.5f, last + 0.4f });

    m.begin("garden wall", "plaster");
    m.box({ 10.2f, -0.05f, -10.0f }, { 10.6f, 4.2f, 10.0f });
    m.begin("garden wall coping", "stone");
    m.box({ 10.12f, 4.21f, -10.05f }, { 10.68f, 4.31f, 10.05f });

    m.begin("wall ivy", "leaf");
    parts::ivy(m, d, 10.2f, -1.0f, -7.5f, 1.5f, 4.2f, 2400);
    m.begin("pergola ivy", "leaf");
    for (int i = 0; i < 3; ++i)
        parts::shrub(m, d, { inner + 0.4f, height + 0.55f, first + pitch * (0.6f + 1.7f * static_cast<float>(i)) }, 0.75f, 360);
}

// Back: z from -10 to -14, floor 0.9 up.
void terrace(mesh_builder& m)
{
    constexpr float rise = 0.15f, tread = 0.34f, floor = 0.9f, edge = -10.2f;
    constexpr int count = 6;
    m.begin("steps", "stone");
    for (int i = 0; i < count; ++i) {
        const float top = rise * static_cast<float>(i + 1);
        const float front = edge + tread * static_cast<float>(count - i);
        const float back = edge + tread * static_cast<float>(count - i - 1) - 0.03f;
        m.slab({ -3.0f, 0.006f, back - (i == count - 1 ? 0.2f : 0.0f) }, { 3.0f, top, front }, 0.015f);
    }
    m.begin("step cheeks", "stone");
    for (const float side : { -1.0f, 1.0f })
        m.box({ side * 3.2f - 0.19f, 0.007f, edge + 0.01f },
              { side * 3.2f + 0.19f, floor + 0.12f, edge + tread * count + 0.12f });

    m.begin("terrace", "asphalt", 1.0f / terrace_picture);
    m.box({ -12.0f, -0.05f, -15.0f }, { 12.0f, floor - 0.01f, edge });

    m.begin("railing left", "iron");
    parts::railing(m, { -6.6f, floor - 0.01f, edge - 0.15f }, { -3.2f, floor - 0.01f, edge - 0.15f }, 1.0f);
    m.begin("railing right", "iron");
    parts::railing(m, { 3.2f, floor - 0.01f, edge - 0.15f }, { 10.0f, floor - 0.01f, edge - 0.15f }, 1.0f);

    m.begin("back wall left", "plaster");
    m.box({ -12.0f, floor - 0.02f, -14.2f }, { -1.9f, 5.2f, -13.7f });
    m.begin("back wall right", "plaster");
    m.box({ 1.9f, floor - 0.02f, -14.2f }, { 12.0f, 5.2f, -13.7f });
    m.begin("back wall coping", "stone");
    m.box({ -12.1f, 5.21f, -14.35f }, { -1.85f, 5.36f, -13.55f });
    m.box({ 1.85f, 5.21f, -14.35f }, { 12.1f, 5.36f, -13.55f });
    for (const float side : { -1.0f, 1.0f }) {
        m.begin(side < 0.0f ? "gate column left" : "gate column right", "stone");
        parts::column(m, { side * 1.5f, floor - 0.005f, -13.45f }, 0.26f, 3.6f);
    }
    m.begin("gate lintel", "stone");
    m.box({ -2.1f, floor + 3.6f, -13.9f }, { 2.1f, floor + 4.05f, -13.0f });
    m.box({ -2.3f, floor + 4.06f, -14.0f }, { 2.3f, floor + 4.2f, -12.85f });
}

void fountain(mesh_builder& m)
{
    m.begin("fountain", "marble");
    const outline_point basin[] = { { 1.45f, 0.01f }, { 1.45f, 0.12f }, { 1.25f, 0.16f }, { 1.3f, 0.5f },   { 1.42f, 0.55f },
                                    { 1.42f, 0.62f }, { 1.18f, 0.62f }, { 1.14f, 0.2f },  { 0.22f, 0.18f }, { 0.14f, 0.45f },
                                    { 0.12f, 0.9f },  { 0.2f, 1.0f },   { 0.5f, 1.12f },  { 0.62f, 1.22f }, { 0.62f, 1.26f },
                                    { 0.55f, 1.25f }, { 0.3f, 1.14f },  { 0.1f, 1.1f },   { 0.08f, 1.3f },  { 0.1f, 1.36f },
                                    { 0.09f, 1.44f }, { 0.05f, 1.49f }, { 0.0f, 1.5f } };
    m.lathe({ -0.6f, 0.0f, -2.2f }, basin, 40);
}

void loose_things(mesh_builder& m, parts::dice& d)
{
    const struct {
        vec3 centre;
        float side;
        float yaw;
    } crates[] = { { { 4.6f, 0.46f, 1.6f }, 0.9f, 12.0f },
                   { { 4.4f, 0.46f, 0.4f }, 0.9f, -20.0f },
                   { { 4.55f, 1.27f, 1.25f }, 0.7f, 35.0f },
                   { { 3.2f, 0.31f, 1.9f }, 0.6f, 50.0f } };
    int number = 0;
    for (const auto& c : crates) {
        m.begin("crate " + std::to_string(number++), "wood");
        parts::crate(m, c.centre, c.side, c.yaw);
    }

    const vec3 tubs[] = { { -4.6f, 0.0f, -7.4f }, { 4.6f, 0.0f, -7.4f }, { -4.9f, 0.0f, 3.4f } };
    const outline_point tub[] = { { 0.36f, 0.01f }, { 0.44f, 0.5f },  { 0.5f, 0.52f }, { 0.5f, 0.6f },
                                  { 0.43f, 0.6f },  { 0.42f, 0.52f }, { 0.0f, 0.5f } };
    number = 0;
    for (const vec3& foot : tubs) {
        m.begin("tub " + std::to_string(number), "clay");
        m.lathe(foot, tub, 24);
        m.begin("shrub " + std::to_string(number++), "leaf");
        parts::shrub(m, d, foot + vec3(0.0f, 1.05f, 0.0f), 0.62f, 650);
    }
}

void distance(mesh_builder& m)
{
    m.begin("distant wall", "stone");
    m.box({ -40.0f, -0.05f, -41.0f }, { 40.0f, 7.0f, -40.0f });
    m.begin("distant towers", "stone");
    for (const float x : { -18.0f, -3.5f, 11.0f, 26.0f })
        m.box({ x - 1.6f, -0.05f, -41.3f }, { x + 1.6f, 9.5f, -39.0f });
    m.begin("distant merlons", "stone");
    for (float x = -39.0f; x < 39.5f; x += 2.0f)
        m.box({ x - 0.5f, 7.01f, -40.9f }, { x + 0.5f, 8.0f, -40.2f });
}

// Materials for the names used above, and snow on the terrace.
void furnish(scene& s)
{
    const auto texture = [&](scene_texture t) {
        s.textures.push_back(std::move(t));
        return static_cast<int>(s.textures.size() - 1);
    };
    const auto material = [&](const std::string& name) {
        const auto found = std::find(s.material_names.begin(), s.material_names.end(), name);
        const auto index = static_cast<std::size_t>(found - s.material_names.begin());
        if (found == s.material_names.end())
            s.material_names.push_back(name);
        s.materials.resize(s.material_names.size());
        return index;
    };
    const auto paint = [&](const std::string& name, const vec3& color) -> ao::standard_material& {
        ao::standard_material& m = s.materials[material(name)];
        m.ambient = m.diffuse = color;
        return m;
    };
    paint("earth", { 0.20f, 0.16f, 0.11f });
    paint("stone", { 0.46f, 0.44f, 0.40f });
    paint("plaster", { 0.66f, 0.58f, 0.46f });
    paint("wood", { 0.30f, 0.19f, 0.10f });
    paint("clay", { 0.44f, 0.19f, 0.11f });

    ao::standard_material& iron = paint("iron", { 0.05f, 0.05f, 0.06f });
    iron.specular = vec3(0.25f);
    iron.shininess = 24.0f;
    ao::standard_material& marble = paint("marble", { 0.62f, 0.60f, 0.57f });
    marble.specular = vec3(0.45f);
    marble.shininess = 90.0f;

    ao::standard_material& leaf = paint("leaf", vec3(1.0f));
    leaf.diffuse_map = leaf.alpha_map = texture(courtyard_textures::leaf());

    // One picture is four slabs of 1.25 m.
    ao::standard_material& paving = paint("paving", vec3(1.0f));
    paving.repeat = glm::vec2(0.2f);
    paving.two_sided = false;
    paving.diffuse_map = texture(courtyard_textures::paving());
    paving.normal_map = texture(courtyard_textures::paving_normals());

    ao::standard_material& asphalt = paint("asphalt", vec3(1.0f));
    asphalt.repeat = glm::vec2(terrace_picture / 2.0f);
    asphalt.specular = vec3(0.08f);
    asphalt.shininess = 12.0f;
    asphalt.diffuse_map = texture(courtyard_textures::asphalt());
    asphalt.normal_map = texture(courtyard_textures::asphalt_normals());
    ao::standard_material& snow = paint("snow", vec3(1.0f));
    snow.repeat = glm::vec2(terrace_picture / 3.0f);
    snow.diffuse_map = texture(courtyard_textures::snow());

    ao::blend_node drifts;
    drifts.first = static_cast<int>(material("asphalt"));
    drifts.second = static_cast<int>(material("snow"));
    drifts.mask = texture(courtyard_textures::drifts());
    s.blends.push_back(drifts);
    s.object_material = materials_of_objects(s);
    const auto terrace = std::find(s.object_names.begin(), s.object_names.end(), "terrace");
    s.object_material[static_cast<std::size_t>(terrace - s.object_names.begin())] = -1;
}

} // namespace

scene courtyard(bool animated)
{
    scene s;
    s.name = "courtyard";
    mesh_builder m(s);
    parts::dice d(2);
    ground(m, d);
    arcade(m);
    pergola(m, d);
    terrace(m);
    fountain(m);
    loose_things(m, d);
    distance(m);
    if (animated)
        parts::screen(m, s);
    furnish(s);
    add_tangents(s, 0, 0);
    return s;
}

camera courtyard_camera()
{
    camera c;
    c.eye = { 4.4f, 2.35f, 8.6f };
    c.yaw = -21.0f;
    c.pitch = -5.0f;
    c.fov = 58.0f;
    return c;
}

camera courtyard_other_camera()
{
    camera c;
    c.eye = { 0.6f, 1.7f, 6.4f };
    c.yaw = -30.0f;
    c.pitch = -4.0f;
    c.fov = 58.0f;
    return c;
}

} // namespace ao::tools
