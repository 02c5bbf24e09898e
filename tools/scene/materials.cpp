#include "materials.hpp"

#include "error.hpp"

#include "ao/scene_check.hpp"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>

namespace ao::tools {
namespace {

constexpr float largest_exponent = 8192.0f;
constexpr float slope_of_bumps = 2.0f;

struct found_map {
    std::string name;
    unsigned uv_set = 0;
    texture_shelf::wrapping wrap;
    aiUVTransform transform;
    bool transformed = false;
};

ao::wrap_mode to_wrap(aiTextureMapMode mode)
{
    switch (mode) {
    case aiTextureMapMode_Clamp:
    case aiTextureMapMode_Decal:
        return ao::wrap_mode::clamp;
    case aiTextureMapMode_Mirror:
        return ao::wrap_mode::mirror;
    default:
        return ao::wrap_mode::repeat;
    }
}

bool finite(const aiUVTransform& t)
{
    return std::isfinite(t.mScaling.x) && std::isfinite(t.mScaling.y) && std::isfinite(t.mTranslation.x) &&
           std::isfinite(t.mTranslation.y) && std::isfinite(t.mRotation);
}

class reader {
public:
    reader(const aiMaterial& of, const std::string& path, texture_shelf& textures, scene& warn_in)
        : from(of),
          shelf(textures),
          warn(warn_in)
    {
        std::string end = path.substr(std::min(path.size(), path.find_last_of('.')));
        std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        gltf = end == ".gltf" || end == ".glb" || end == ".vrm";
    }
    read_material read();

private:
    std::optional<found_map> map(aiTextureType type) const;
    glm::vec3 color(const char* key, unsigned type, unsigned index, float otherwise) const;
    float number(const char* key, unsigned type, unsigned index, float otherwise) const;
    // Where the maps lie: the first one's set and transform hold for all.
    void place(const found_map& m);
    void read_transform(const found_map& m);
    void read_diffuse();
    void read_normals();
    void read_alpha();
    void read_specular();
    void read_emission();

    const aiMaterial& from;
    texture_shelf& shelf;
    scene& warn;
    bool gltf = false;
    read_material to;
    std::optional<found_map> placed;
    std::optional<found_map> diffuse;
    float diffuse_alpha = 1.0f;
};

std::optional<found_map> reader::map(aiTextureType type) const
{
    if (from.GetTextureCount(type) == 0)
        return std::nullopt;
    aiString name;
    aiTextureMapMode modes[2] = { aiTextureMapMode_Wrap, aiTextureMapMode_Wrap };
    found_map m;
    if (from.GetTexture(type, 0, &name, nullptr, &m.uv_set, nullptr, nullptr, modes) != aiReturn_SUCCESS || name.length == 0)
        return std::nullopt;
    m.name = name.C_Str();
    m.wrap = { to_wrap(modes[0]), to_wrap(modes[1]) };
    m.transformed = from.Get(AI_MATKEY_UVTRANSFORM(type, 0), m.transform) == aiReturn_SUCCESS && finite(m.transform);
    return m;
}

glm::vec3 reader::color(const char* key, unsigned type, unsigned index, float otherwise) const
{
    aiColor3D c(otherwise, otherwise, otherwise);
    if (from.Get(key, type, index, c) != aiReturn_SUCCESS || !std::isfinite(c.r) || !std::isfinite(c.g) || !std::isfinite(c.b))
        return glm::vec3(otherwise);
    return { c.r, c.g, c.b };
}

float reader::number(const char* key, unsigned type, unsigned index, float otherwise) const
{
    float x = otherwise;
    return from.Get(key, type, index, x) == aiReturn_SUCCESS && std::isfinite(x) ? x : otherwise;
}

void reader::place(const found_map& m)
{
    if (!placed) {
        placed = m;
        to.uv_set = m.uv_set;
        if (m.transformed)
            read_transform(m);
        return;
    }
    const bool same = m.uv_set == placed->uv_set && m.transformed == placed->transformed &&
                      (!m.transformed || (m.transform.mScaling == placed->transform.mScaling &&
                                          m.transform.mTranslation == placed->transform.mTranslation &&
                                          m.transform.mRotation == placed->transform.mRotation));
    if (!same)
        warn.warnings.push_back(warn.name + ": texture '" + one_line(m.name) + "': drawn at the coordinates of '" +
                                one_line(placed->name) + "', not at its own");
}

// Assimp's transform, v upward: turn counter-clockwise about (0.5, 0.5), scale, shift.
void reader::read_transform(const found_map& m)
{
    const aiUVTransform& t = m.transform;
    const auto sx = static_cast<double>(t.mScaling.x), sy = static_cast<double>(t.mScaling.y);
    const double c = std::cos(static_cast<double>(t.mRotation)), n = std::sin(static_cast<double>(t.mRotation));
    glm::dmat2 turn;
    glm::dvec2 shift;
    if (gltf) {
        // KHR_texture_transform, v downward, about the corner: what the importer made of it, undone.
        turn = glm::dmat2(c * sx, n * sx, -n * sy, c * sy);
        shift.x = static_cast<double>(t.mTranslation.x) - 0.5 * sx * (1.0 - c - n);
        shift.y = 0.5 * sy * (c - n - 1.0) + 1.0 - sy - static_cast<double>(t.mTranslation.y);
    }
    else {
        // With v = 1 - v on both sides.
        turn = glm::dmat2(c * sx, -n * sy, n * sx, c * sy);
        const glm::dvec2 centre(0.5, 0.5);
        const glm::dvec2 moved = glm::dvec2(sx, sy) * centre + glm::dvec2(t.mTranslation.x, t.mTranslation.y);
        shift = glm::dvec2(moved.x, 1.0 - moved.y) - turn * centre;
    }
    const auto whole = [](double x, ao::wrap_mode wrap) {
        return wrap == ao::wrap_mode::repeat ? std::abs(x - std::round(x)) < 1.0e-6 : std::abs(x) < 1.0e-6;
    };
    if (n == 0.0 && c == 1.0 && sx > 0.0 && sy > 0.0 && whole(shift.x, m.wrap.u) && whole(shift.y, m.wrap.v)) {
        to.material.repeat = glm::vec2(turn[0][0], turn[1][1]);
        return;
    }
    to.turn = glm::mat2(turn);
    to.shift = glm::vec2(shift);
}

void reader::read_diffuse()
{
    aiColor4D base(0.8f, 0.8f, 0.8f, 1.0f);
    if (!gltf || from.Get(AI_MATKEY_BASE_COLOR, base) != aiReturn_SUCCESS) {
        const glm::vec3 c = color(AI_MATKEY_COLOR_DIFFUSE, gltf ? 1.0f : 0.8f);
        base = aiColor4D(c.r, c.g, c.b, 1.0f);
    }
    to.material.diffuse = glm::vec3(base.r, base.g, base.b);
    diffuse_alpha = base.a;
    diffuse = map(aiTextureType_BASE_COLOR);
    if (!diffuse)
        diffuse = map(aiTextureType_DIFFUSE);
    if (diffuse) {
        place(*diffuse);
        to.material.diffuse_map = shelf.add(diffuse->name, texture_use::color, diffuse->wrap);
        if (!gltf && to.material.diffuse == glm::vec3(0.0f))
            to.material.diffuse = glm::vec3(1.0f);
    }
    to.material.ambient = to.material.diffuse;
}

void reader::read_normals()
{
    std::optional<found_map> m = map(aiTextureType_NORMALS);
    float multiplier = 1.0f;
    if (m) {
        multiplier = number(AI_MATKEY_OBJ_BUMPMULT_NORMALS(0), 1.0f);
    }
    else {
        m = map(aiTextureType_HEIGHT);
        multiplier = number(AI_MATKEY_OBJ_BUMPMULT_HEIGHT(0), 1.0f);
    }
    if (!m)
        return;
    place(*m);
    to.material.normal_map =
        gltf ? shelf.add(m->name, texture_use::normals, m->wrap) : shelf.add_bumps(m->name, slope_of_bumps * multiplier, m->wrap);
}

void reader::read_alpha()
{
    if (gltf) {
        aiString mode;
        if (from.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) != aiReturn_SUCCESS || !diffuse)
            return;
        const std::string_view words = mode.C_Str();
        if ((words != "MASK" && words != "BLEND") || !shelf.has_alpha(diffuse->name))
            return;
        const float cutoff = words == "MASK" ? number(AI_MATKEY_GLTF_ALPHACUTOFF, 0.5f) : 0.5f;
        to.material.alpha_map = to.material.diffuse_map;
        // texel * factor < cutoff; a factor of 0 cuts all.
        to.material.alpha_cutoff = diffuse_alpha > 0.0f ? std::min(cutoff / diffuse_alpha, 2.0f) : cutoff > 0.0f ? 2.0f : 0.0f;
        return;
    }
    const std::optional<found_map> m = map(aiTextureType_OPACITY);
    if (!m) {
        int flags = 0;
        if (diffuse && shelf.has_alpha(diffuse->name) && from.Get(AI_MATKEY_TEXFLAGS_DIFFUSE(0), flags) == aiReturn_SUCCESS &&
            (flags & aiTextureFlags_UseAlpha) != 0)
            to.material.alpha_map = to.material.diffuse_map;
        return;
    }
    place(*m);
    const bool in_alpha = shelf.has_alpha(m->name);
    to.material.alpha_from_red = !in_alpha;
    const bool shared = in_alpha && diffuse && diffuse->name == m->name && diffuse->wrap == m->wrap;
    to.material.alpha_map = shared ? to.material.diffuse_map : shelf.add(m->name, texture_use::mask, m->wrap);
}

void reader::read_specular()
{
    int model = aiShadingMode_Blinn;
    const bool stated = from.Get(AI_MATKEY_SHADING_MODEL, model) == aiReturn_SUCCESS;
    to.material.model = stated && model == aiShadingMode_Phong && !gltf ? ao::specular_model::phong : ao::specular_model::blinn;
    float roughness = 1.0f;
    if (gltf && from.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == aiReturn_SUCCESS && std::isfinite(roughness)) {
        const float width = std::clamp(roughness * roughness, 0.0f, 1.0f);
        to.material.shininess = std::min(2.0f / std::max(width * width, 1.0e-9f) - 2.0f, largest_exponent);
        to.material.specular = glm::vec3(to.material.shininess < 1.0f ? 0.0f : 0.04f);
        return;
    }
    const float exponent = std::clamp(number(AI_MATKEY_SHININESS, 0.0f), 0.0f, largest_exponent);
    if (exponent == 0.0f || (stated && (model == aiShadingMode_NoShading || model == aiShadingMode_Gouraud)))
        return;
    to.material.shininess = exponent;
    to.material.specular = color(AI_MATKEY_COLOR_SPECULAR, 0.0f) * number(AI_MATKEY_SHININESS_STRENGTH, 1.0f);
    if (const auto m = map(aiTextureType_SPECULAR)) {
        place(*m);
        to.material.specular_map = shelf.add(m->name, texture_use::color, m->wrap);
        if (to.material.specular == glm::vec3(0.0f))
            to.material.specular = glm::vec3(1.0f);
    }
}

void reader::read_emission()
{
    if (map(aiTextureType_EMISSIVE) || map(aiTextureType_EMISSION_COLOR))
        return;
    to.material.emission = color(AI_MATKEY_COLOR_EMISSIVE, 0.0f);
}

read_material reader::read()
{
    read_diffuse();
    read_normals();
    read_alpha();
    read_specular();
    read_emission();
    // Several would be the faces of a cube.
    if (from.GetTextureCount(aiTextureType_REFLECTION) == 1)
        if (const auto m = map(aiTextureType_REFLECTION))
            to.material.reflection_map = shelf.add(m->name, texture_use::color, {});
    int two_sided = 0;
    to.material.two_sided = !gltf || (from.Get(AI_MATKEY_TWOSIDED, two_sided) == aiReturn_SUCCESS && two_sided != 0);
    return to;
}

} // namespace

read_material read_one(const aiMaterial& from, const std::string& model, texture_shelf& shelf, scene& warn)
{
    return reader(from, model, shelf, warn).read();
}

picture decode_embedded(const aiTexture& t)
{
    if (t.pcData == nullptr)
        throw error("the picture is empty");
    if (t.mHeight == 0)
        return decode_picture({ reinterpret_cast<const std::uint8_t*>(t.pcData), t.mWidth });
    constexpr unsigned most = ao::max_texture_size;
    if (t.mWidth == 0 || t.mWidth > most || t.mHeight > most || static_cast<long>(t.mWidth) * t.mHeight > largest_picture)
        throw error(std::to_string(t.mWidth) + " x " + std::to_string(t.mHeight) + " pixels");
    picture p;
    p.width = static_cast<int>(t.mWidth);
    p.height = static_cast<int>(t.mHeight);
    p.has_alpha = true;
    const std::size_t count = std::size_t{ t.mWidth } * t.mHeight;
    p.rgba.reserve(4 * count);
    for (std::size_t i = 0; i < count; ++i)
        p.rgba.insert(p.rgba.end(), { t.pcData[i].r, t.pcData[i].g, t.pcData[i].b, t.pcData[i].a });
    return p;
}

bool has_maps(const ao::standard_material& m)
{
    return m.diffuse_map != ao::no_texture || m.alpha_map != ao::no_texture || m.normal_map != ao::no_texture ||
           m.specular_map != ao::no_texture;
}

ao::standard_material without_maps(ao::standard_material m)
{
    m.diffuse_map = m.alpha_map = m.normal_map = m.specular_map = ao::no_texture;
    return m;
}

} // namespace ao::tools
